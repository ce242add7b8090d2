#pragma once

#include "equilibrium/equilibrium.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Takes a curve to the elastica that it relaxes to: of all curves of its length between held nodes, the one that is
/// bent least nearby (Euler 1744; ∫ κ² ds, Σ |t − t′|²/ℓ by the directions t of edges). There is one from any start,
/// also where springs have no equilibrium, as between the ends of a helix or of most spirals; and on the way no winding
/// is lost. Lengths between held nodes are those of the curve as it is, spread as its runs have them
/// (MovingRun::along). Given tangents are kept, free ends are straight, and a curve in a plane stays there. Newton's
/// steps by the directions, with the force in each piece as the multiplier of its chord, taken only where bending
/// falls; where the equations have no minimum there, steps are shorter. converged: no node is expected to go further
/// than the tolerance. Of the task it needs tolerance, max_iterations, most_work and on_iteration. Cost: linear for
/// each step; most curves take ten.
EquilibriumResult relax_to_elastica(Net& net, const EquilibriumTask& task, Context& context);

}  // namespace vspring
