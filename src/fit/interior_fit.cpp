#include "fit/interior_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

constexpr int most_barriers = 60;
// In squared tolerances.
constexpr double least_first_barrier = 0.02;
// Factor of the barrier after steps that are long enough.
constexpr double fall = 0.3;
constexpr double long_step = 0.5;
// Before which it is not called so.
constexpr int fewest_steps_down = 3;
// Number of short steps in a row after which the shape counts as the fairest.
constexpr int patience_for_steps = 8;
// The lowest barrier, in squared tolerances: lower ones move nothing.
constexpr double lowest_barrier = 1e-5;
// Factor of the energy in a step.
constexpr double still_falls = 0.99;
// When no step helps any more, at a barrier this low the shape is about as fair as it can be.
constexpr double low_barrier = 1e-2;
// The largest share of its distance from the bound by which a step may move a point.
constexpr double greatest_approach = 0.9;
// A point beyond counts as if it were this near to the bound, in tolerances.
constexpr double nearest_to_bound = 1e-3;
// Share of the tolerance that the points are held within: the rest is for points that do not pull, and for steps that
// are too long.
constexpr double aimed_share_of_bounds = 0.995;
constexpr double greatest_rise = 1.1;
// Shorter steps lead nowhere.
constexpr double least_step = 0.005;

/// A point between its bounds.
struct Bounded {
  std::size_t slot;  ///< among the tied points
  double height;     ///< of the shape over it, with its sign, in tolerances
  double excess;     ///< of that over the node's along its normal, which is what the point pulls by
  double upper;      ///< multipliers of both bounds
  double lower;
};

class InteriorFit {
 public:
  InteriorFit(const ToleranceFitTask& task, double tolerance)
      : task_(task),
        net_(*task.net),
        tolerance_(tolerance),
        bound_(aimed_share_of_bounds * tolerance),
        places_(net_.points.positions),
        weights_(net_.points.weights) {}

  ToleranceFitResult run(ToleranceFitResult result) {
    best_ = net_.positions;
    result.within = result.settled = false;
    try {
      approach(result);
    } catch (const Cancelled&) {
      // The best so far stays.
    }
    let_go();
    net_.positions = best_;
    result.settled = result.settled && result.within;
    return result;
  }

 private:
  /// Step by step, barriers falling.
  void approach(ToleranceFitResult& result) {
    measure();
    look(result);
    double barrier = 0;
    for (const Bounded& point : points_) {
      const double height = std::abs(point.height);
      barrier += height * std::max(1 - height, nearest_to_bound) / static_cast<double>(points_.size());
    }
    barrier = std::max(barrier, least_first_barrier);
    set_multipliers(barrier);
    double last = 1;
    double energy_before = 0;
    int short_steps = 0;
    for (int step = 0; step < most_barriers && !points_.empty(); ++step) {
      // Where points pulled strongly at first, it may be low while they still pull more than they need to.
      if (barrier < lowest_barrier && !(energy_ > 0 && energy_ < still_falls * energy_before)) {
        result.settled = true;
        break;
      }
      energy_before = energy_;
      if (last >= long_step) {
        // Points beyond their bounds come back first.
        if (result.within) barrier *= fall;
        short_steps = 0;
      } else if (++short_steps == patience_for_steps) {
        result.settled = barrier < low_barrier && step >= fewest_steps_down;
        break;
      }
      const std::vector<Vector3> start = net_.positions;
      const std::vector<Bounded> before = points_;
      pull(barrier);
      const bool found = task_.update(false);
      let_go();
      if (task_.ended()) break;
      measure();
      const double share = found ? step_within(before) : 0;
      if (share < least_step) {
        net_.positions = start;
        result.settled = barrier < low_barrier && step >= fewest_steps_down;
        break;
      }
      if (share < 1) {
        for (std::size_t i = 0; i < net_.moving; ++i)
          net_.positions[i] = start[i] + share * (net_.positions[i] - start[i]);
        measure();
      }
      last = share;
      renew_multipliers(before, barrier, share);
      look(result);
      // The first barriers may be too high for a start that is hardly within the tolerance.
      if (result.within && step >= fewest_steps_down && energy_ > greatest_rise * least_energy_) {
        result.settled = true;
        break;
      }
    }
  }

  /// Measures the heights of all pulling points over the present shape.
  void measure() {
    distances_ = task_.measure();
    greatest_ = *std::max_element(distances_.begin(), distances_.end()) / tolerance_;
    std::vector<double> heights(places_.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<double> excesses(places_.size(), 0);
    for (std::size_t i = 0; i < net_.moving; ++i) {
      const Vector3 across = net_.normals[i];
      for (const std::uint32_t k : net_.points.of(i)) {
        heights[k] = std::copysign(distances_[net_.points.numbers[k]] / bound_,
                                   (net_.positions[i] - places_[k]).dot(net_.normals[i]));
        excesses[k] = heights[k] - (net_.positions[i] - places_[k]).dot(across) / bound_;
      }
    }
    std::vector<Bounded> now;
    std::size_t next = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      while (next < points_.size() && points_[next].slot < k) ++next;
      if (std::isnan(heights[k]) || !(weights_[k] > 0)) continue;
      const bool known = next < points_.size() && points_[next].slot == k;
      now.push_back({k, heights[k], excesses[k], known ? points_[next].upper : -1, known ? points_[next].lower : -1});
    }
    points_ = std::move(now);
  }

  void set_multipliers(double barrier) {
    for (Bounded& point : points_) {
      if (point.upper >= 0) continue;
      point.upper = barrier / room(1 - point.height);
      point.lower = barrier / room(1 + point.height);
    }
  }

  static double room(double left) { return std::max(left, nearest_to_bound); }

  /// Stiffness and balance of a point's two bounds, linear in its height: it pulls by stiffness · (height − balance).
  struct Pull {
    double stiffness;
    double balance;
  };
  static Pull pull_of(const Bounded& point, double barrier) {
    const double above = room(1 - point.height);
    const double below = room(1 + point.height);
    const double stiffness = point.upper / above + point.lower / below;
    const double height = std::clamp(point.height, nearest_to_bound - 1, 1 - nearest_to_bound);
    return {stiffness, height - (barrier / above - barrier / below) / stiffness};
  }

  void pull(double barrier) {
    const std::vector<std::uint32_t> node = nodes_of_points();
    for (const Bounded& point : points_) {
      const Pull pull = pull_of(point, barrier);
      net_.points.weights[point.slot] = weights_[point.slot] * pull.stiffness;
      net_.points.positions[point.slot] =
          places_[point.slot] + (pull.balance - point.excess) * bound_ * net_.normals[node[point.slot]];
    }
  }

  void let_go() {
    net_.points.positions = places_;
    net_.points.weights = weights_;
  }

  [[nodiscard]] std::vector<std::uint32_t> nodes_of_points() const {
    std::vector<std::uint32_t> node(places_.size(), 0);
    for (std::size_t i = 0; i < net_.moving; ++i) {
      for (const std::uint32_t k : net_.points.of(i)) node[k] = static_cast<std::uint32_t>(i);
    }
    return node;
  }

  /// The share of the step to the shape measured last that keeps all points within their bounds.
  double step_within(const std::vector<Bounded>& before) const {
    double share = 1;
    std::size_t next = 0;
    for (const Bounded& from : before) {
      while (next < points_.size() && points_[next].slot < from.slot) ++next;
      if (next == points_.size() || points_[next].slot != from.slot) continue;
      const double to = points_[next].height;
      const double bound = std::copysign(1.0, to);
      const double left = bound * (bound - from.height);
      const double way = bound * (to - from.height);
      if (left <= nearest_to_bound) continue;
      if (way > greatest_approach * left) share = std::min(share, greatest_approach * left / way);
    }
    return share;
  }

  /// Multipliers go with the heights, at most nine tenths of the way to zero.
  void renew_multipliers(const std::vector<Bounded>& before, double barrier, double share) {
    std::size_t next = 0;
    for (const Bounded& from : before) {
      while (next < points_.size() && points_[next].slot < from.slot) ++next;
      if (next == points_.size() || points_[next].slot != from.slot) continue;
      Bounded& now = points_[next];
      const double rise = (now.height - from.height) / share;
      const double upper = (barrier + from.upper * rise) / room(1 - from.height);
      const double lower = (barrier - from.lower * rise) / room(1 + from.height);
      now.upper = std::max(upper, (1 - greatest_approach) * from.upper);
      now.lower = std::max(lower, (1 - greatest_approach) * from.lower);
    }
    set_multipliers(barrier);
  }

  void look(ToleranceFitResult& result) {
    const bool within = greatest_ <= 1;
    energy_ = within ? task_.energy() : 0;
    if (within ? !(energy_ > greatest_rise * least_energy_) : !result.within && greatest_ < least_greatest_)
      best_ = net_.positions;
    if (within) least_energy_ = std::min(least_energy_, energy_);
    least_greatest_ = std::min(least_greatest_, greatest_);
    result.within = result.within || within;
  }

  const ToleranceFitTask& task_;
  Net& net_;
  double tolerance_;
  double bound_;
  const std::vector<Vector3> places_;
  const std::vector<double> weights_;
  std::vector<double> distances_;
  std::vector<Bounded> points_;  ///< those that pull, by their slots
  std::vector<Vector3> best_;
  double greatest_ = 0;
  double energy_ = 0;
  double least_energy_ = std::numeric_limits<double>::infinity();
  double least_greatest_ = std::numeric_limits<double>::infinity();
};

}  // namespace

ToleranceFitResult hold_between(const ToleranceFitTask& task, double tolerance, ToleranceFitResult smooth) {
  return InteriorFit(task, tolerance).run(smooth);
}

}  // namespace vspring
