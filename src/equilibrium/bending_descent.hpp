#pragma once

#include "base/threads.hpp"
#include "equilibrium/equilibrium.hpp"
#include "spring/model.hpp"

namespace vspring {

/// Takes a surface to where it is bent least, from any shape, whether its springs have an equilibrium or not: by steps
/// across it that are taken only where the BendingEnergy falls, with what points pull by, if there are any: as much as
/// against springs that do not see the mesh. The form of quadratics says where to (Gauss and Newton), conjugate to the
/// step before, and a line search how far. Begins without the noise in the spacing, where that is bent less. If no edge
/// turns by over 90° there, none does later: nodes whose faces would turn over stay from then on. Else it leaves the
/// last shape where no more did than at first. With a home, the energy also has Σ M d²/L⁴, d the distance of a node
/// from there, M its share of the faces and L the smoothing length. converged: no node is expected to go further than
/// the task's tolerance, or the energy falls no further. net: with all rings, as for sphere springs. Cost of a step:
/// that of a sparse factor, and about six iterations of the equilibrium solver.
EquilibriumResult descend_bending(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                                  Context& context);

}  // namespace vspring
