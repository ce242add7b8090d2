#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fit/warm_started_fit.hpp"
#include "points/point_clusters.hpp"

namespace vspring {

/// The fairest shape whose points all lie within a distance, or whose distances have a root mean square. `follow` goes
/// to the equilibrium, from the shape before; `measure` gives the distances of all points, as they came, from the shape
/// of the net as it is then, in the coordinates of the net; `energy` says how fair that shape is.
struct ToleranceFitTask {
  Net* net = nullptr;
  std::shared_ptr<double> length;  ///< the smoothing length that points pull by, in the coordinates of the net
  /// or_find: where nothing is found from there, it may begin anew. False where nothing is found.
  std::function<bool(bool or_find)> update;
  std::function<bool()> ended;                   ///< cancelled, or out of work: the best so far stays
  std::function<std::vector<double>()> measure;  ///< may throw Cancelled: the best so far stays
  std::function<double()> energy;
  bool found = true;          ///< whether the net is at an equilibrium
  double close_share = 0.01;  ///< of the tolerance: smooth_within() need not come nearer
  /// Where shorter lengths come no nearer to the tolerance, it takes the longest one whose shape is about as near.
  bool takes_nearest = false;
};

struct ToleranceFitResult {
  bool within = false;   ///< whether the shape that is left in the net is
  bool settled = false;  ///< whether it is the fairest, as far as the search can tell
  double length = 0;     ///< of the smoothing that was found
};

/// Finds the largest smoothing length whose shape is within: tolerated(distances) is the figure that may be at most
/// `tolerance`. Begins with the shape of the net and the length in the task. Leaves the shape in the net.
ToleranceFitResult smooth_within(const ToleranceFitTask& task, double tolerance,
                                 const std::function<double(const std::vector<double>&)>& tolerated);

}  // namespace vspring
