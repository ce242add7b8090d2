#pragma once

#include <functional>

#include "base/threads.hpp"
#include "equilibrium/equilibrium.hpp"
#include "fit/tolerance_fit.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The least bent surface that passes its points within a distance.
struct BendWithinTask {
  Net* net = nullptr;   ///< with its points tied
  double distance = 0;  ///< in the coordinates of the net
  /// Goes to the shape of least energy with these bounds, from that of the net.
  std::function<void(const PointBounds&)> descend;
  /// Of the points that count, how far the furthest is from the shape of the net, as a share of the distance. May throw
  /// Cancelled: the best so far stays.
  std::function<double()> furthest;
  std::function<bool()> ended;  ///< cancelled, or out of work: the best so far stays
};

/// By an interior-point method (Boyd and Vandenberghe 2004, §11.3) whose barriers are relaxed, so that it may begin
/// with points beyond their bounds. Leaves the least bent shape within the distance in the net; where there is none,
/// the nearest. settled: no other is expected to bend less by over 1 %.
ToleranceFitResult bend_within(const BendWithinTask& task, ThreadTeam& team);

}  // namespace vspring
