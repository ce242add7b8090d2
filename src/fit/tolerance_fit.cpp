// Tolerances in place of weights.

#include "fit/tolerance_fit.hpp"

#include "base/cancellation.hpp"
#include "equilibrium/account.hpp"

namespace vspring {

namespace {

// Smoothing lengths that are tried, in mean edges and in sizes of the shape.
constexpr double shortest_length = 0.02;
constexpr double longest_length = 10;
constexpr double stride = 2;
// Lengths in a row for which nothing was found: then shorter ones find nothing either.
constexpr int most_lost = 3;
// As multiples of the least figure: where so many halvings of the length, to less than an edge, do not lower it, the
// longest length is taken that comes about as near.
constexpr double about_as_near = 1.05;
constexpr double no_nearer = 0.99;
constexpr int halvings_without_gain = 2;
constexpr int most_trials = 60;
}  // namespace

ToleranceFitResult smooth_within(const ToleranceFitTask& task, double tolerance,
                                 const std::function<double(const std::vector<double>&)>& tolerated) {
  Net& net = *task.net;
  const double longest = longest_length * diagonal(net);
  ToleranceFitResult result;
  std::vector<Vector3> best = net.positions;
  double least = std::numeric_limits<double>::infinity();
  double nearest = *task.length;
  double nearest_figure = least;
  int without_gain = 0;
  const double edge = mean_edge(net);
  const double shortest = shortest_length * edge;
  // Lengths within and beyond the tolerance, and the figures there.
  std::optional<std::pair<double, double>> inside;
  std::optional<std::pair<double, double>> outside;
  const auto look = [&](bool found) {
    const double figure = found ? tolerated(task.measure()) : std::numeric_limits<double>::infinity();
    const bool within = figure <= tolerance;
    if (within && (!inside || *task.length > inside->first)) {
      inside = {*task.length, figure};
      best = net.positions;
    } else if (!within) {
      // Where shorter lengths find nothing, those between are unknown.
      if (!outside || (*task.length < outside->first && (found || inside))) outside = {*task.length, figure};
      if (!inside && figure < least) {
        if (!task.takes_nearest || !(figure > nearest_figure / about_as_near)) {
          best = net.positions;
          nearest = *task.length;
          nearest_figure = figure;
        }
        without_gain = figure < no_nearer * least || *task.length > edge ? 0 : without_gain + 1;
      } else if (!inside && found && *task.length < edge) {
        ++without_gain;
      }
    }
    least = std::min(least, figure);
  };
  try {
    look(task.found);
    int lost = 0;
    double step = stride;
    for (int turn = 0; turn < most_trials; ++turn) {
      if (!outside) {
        if (*task.length >= longest) break;
        *task.length *= stride;
      } else if (!inside) {
        if (*task.length <= shortest || lost == most_lost ||
            (task.takes_nearest && without_gain == halvings_without_gain))
          break;
        // Nearer to the last one that was found.
        if (lost > 0) *task.length *= step;
        step = lost > 0 ? std::sqrt(step) : stride;
        *task.length /= step;
      } else {
        const auto& [a, at_a] = *inside;
        const auto& [b, at_b] = *outside;
        if (at_a >= (1 - task.close_share) * tolerance || b < (1 + task.close_share) * a) break;
        // Between both by their logarithms, a little nearer to the one within, and not at the ends.
        const double share = at_b > at_a && at_a > 0 && std::isfinite(at_b)
                                 ? std::log(tolerance / at_a) / std::log(at_b / at_a) - 0.02
                                 : 0.5;
        *task.length = a * std::pow(b / a, std::clamp(share, 0.1, 0.9));
      }
      if (inside) net.positions = best;
      const std::vector<Vector3> start = net.positions;
      const bool found = task.update(true);
      if (!found && net.points.are_nodes) net.positions = start;
      if (task.ended()) break;
      lost = found ? 0 : lost + 1;
      look(found);
    }
  } catch (const Cancelled&) {
    // The best so far stays.
  }
  net.positions = best;
  result.within = inside.has_value();
  result.settled = result.within && !task.ended();
  result.length = inside ? inside->first : nearest;
  *task.length = result.length;
  return result;
}

}  // namespace vspring
