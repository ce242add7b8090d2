#include "fit/bend_within.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/cancellation.hpp"
#include "checks/bending_energy.hpp"

namespace vspring {

namespace {

// The rest of the distance is for the last step.
constexpr double aimed_share = 0.995;
// Of the distance, where barriers become quadratic at first.
constexpr double first_relaxed = 0.1;
// Factor of both from one descent to the next.
constexpr double fall_of_barriers = 0.3;
// Barriers narrower than this hold points no better.
constexpr double least_relaxed = 1e-6;
// As shares of the bending: by how much it may be above the least (m barriers of factor μ leave m μ), and from one
// shape within the distance to the next.
constexpr double near_to_least = 0.01;
constexpr double least_gain = 0.005;

/// The barrier that holds points about as strongly as a smoothing length of one edge.
double first_barrier(const Net& net, const BendingEnergy& bending, double distance, double points) {
  double area = 0;
  for (std::size_t i = 0; i < net.moving; ++i) area += bending.area(net.positions, i);
  const double edge = mean_edge(net);
  return area / points * distance * distance / (edge * edge * edge * edge);
}

}  // namespace

ToleranceFitResult bend_within(const BendWithinTask& task, ThreadTeam& team) {
  Net& net = *task.net;
  const BendingEnergy bending(net);
  double points = 0;
  for (std::size_t i = 0; i < net.moving; ++i) points += static_cast<double>(net.points.of(i).size());
  PointBounds bounds{.distance = aimed_share * task.distance, .relaxed = first_relaxed};
  bounds.barrier = first_barrier(net, bending, bounds.distance, points);
  ToleranceFitResult result;
  std::vector<Vector3> best = net.positions;
  double furthest = std::numeric_limits<double>::infinity();
  double bent = furthest;
  bool was_within = true;
  try {
    while (points > 0 && bounds.relaxed > least_relaxed) {
      task.descend(bounds);
      const double now = task.furthest();
      const double bent_now = bending.of(net.positions, team);
      const bool within = now <= 1;
      result.settled = within && (2 * points * bounds.barrier < near_to_least * bent_now ||
                                  (result.within && bent_now > (1 - least_gain) * bent));
      if (within ? !result.within || bent_now < bent : !result.within && now < furthest) {
        best = net.positions;
        furthest = now;
        bent = bent_now;
        result.within = within;
      }
      if (result.settled || task.ended()) break;
      // Points beyond come back first.
      if (within || was_within) bounds.barrier *= fall_of_barriers;
      was_within = within || !was_within;
      bounds.relaxed *= fall_of_barriers;
    }
  } catch (const Cancelled&) {
    // The best so far stays.
  }
  net.positions = best;
  return result;
}

}  // namespace vspring
