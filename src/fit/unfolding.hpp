#pragma once

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Takes out of the moving nodes of a surface the noise that folds it: some steps of Taubin's λ|μ filter (G. Taubin, "A
/// signal processing approach to fair surface design", SIGGRAPH 1995), and around edges that still turn by more than
/// 90° steps towards the neighbours' mean. Leaves it as it is where fewer than one edge in 200 turns by more than 90°,
/// which may be what the shape is like, or more than a tenth of these go on turning after the filter. Held nodes stay.
/// Cost: linear; the same result on any number of threads.
void unfold(Net& net, ThreadTeam& team);

}  // namespace vspring
