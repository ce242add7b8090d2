#pragma once

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

enum class Unfold {
  where_many_edges_turn,  ///< at least one in 200, by more than 90°: fewer may be what the shape is like
  where_any_edge_turns    ///< of what is known to be noisy
};

/// Takes out of the moving nodes of a surface the noise that folds it: some steps of Taubin's λ|μ filter (G. Taubin, "A
/// signal processing approach to fair surface design", SIGGRAPH 1995), and around edges that still turn by more than
/// 90° steps towards the neighbours' mean. Leaves it as it is where that is not asked for, or more than a tenth of the
/// edges go on turning after the filter. Held nodes stay. Cost: linear; the same result on any number of threads.
void unfold(Net& net, Unfold when, ThreadTeam& team);

}  // namespace vspring
