#pragma once

#include "base/threads.hpp"
#include "equilibrium/equilibrium.hpp"
#include "spring/model.hpp"

namespace vspring {

/// Finds the least bent shape of a surface, from any shape, whether its springs have an equilibrium or not. Steps
/// across the surface are taken only where the BendingEnergy falls, to which the energy of points that pull is added;
/// these pull as strongly as against springs. The second derivative gives the direction of steps (Gauss and Newton),
/// conjugate to the step before, and a line search their length. Begins without the noise in the spacing, where the
/// shape is bent less then. If no edge turns by over 90° at the start, none does later: nodes whose faces would turn
/// over stay from then on. Else it returns the last shape in which no more edges did than at first. With a home, Σ M
/// d²/L⁴ is added to the energy, d the distance of a node from there, M its share of the faces and L the smoothing
/// length. converged: no node is expected to go further than the task's tolerance, or the energy falls no further. net:
/// with all rings, as for sphere springs. Cost of a step: that of a sparse factor, and about six iterations of the
/// equilibrium solver.
EquilibriumResult descend_bending(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                                  Context& context);

}  // namespace vspring
