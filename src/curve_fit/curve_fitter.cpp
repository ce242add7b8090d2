#include "curve_fit/curve_fitter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "curve_fit/curve_descent.hpp"
#include "curve_fit/curve_lengths.hpp"
#include "curve_fit/first_curve.hpp"

namespace vspring {

namespace {

constexpr int most_grids = 4;
// While corners move.
constexpr int most_steps_of_corners = 8;
constexpr int grids_of_corners = 3;
// As a share of the first energy.
constexpr double next_to_no_energy = 1e-6;
constexpr int most_trials_of_weight = 24;
constexpr double near_rms = 0.985;
// As a share of the root mean square of points that can be moved: below it the curve follows their noise.
constexpr double least_share_of_rms = 0.95;
constexpr double next_to_no_weight = 1e-3;
constexpr double stride_of_weight = 10;
constexpr double near_weight = 1.02;

template <int K>
class CurveFitter {
 public:
  CurveFitter(const CurveFitTask& task, const std::function<void(double)>& progress)
      : task_(task), progress_(progress), descent_(task), found_(descent_.found) {}

  CurveFound run() {
    if (task_.nodes) return run_on_nodes();
    found_ = task_.start ? *task_.start : start_of(task_);
    set_bounds(task_, found_);
    // Each point represents an equal share of the length.
    if (found_.smoothing > 0)
      descent_.data_weight =
          length_of(found_.curve) / static_cast<double>(found_.points.size()) * std::pow(found_.smoothing, -4);
    if (descent_.has_corners()) place_corners();
    bool is_finer = false;
    for (int grid = 0; grid < most_grids; ++grid) {
      const std::size_t before = descent_.spent();
      descent_.begin_grid();
      if (task_.rms > 0)
        go_to_rms();
      else
        descent_.go();
      progress_(static_cast<double>(grid + 1) / most_grids);
      if (descent_.is_out_of_work() || grid + 1 == most_grids) break;
      // On finer nodes little is left to do: what does not end there does not go on.
      if (found_.converged ? !refine(descent_.spent() - before) : is_finer) break;
      is_finer = found_.converged;
    }
    fit_ends(found_);
    measure();
    return std::move(found_);
  }

 private:
  /// Fits given nodes, whose chords are the curve.
  CurveFound run_on_nodes() {
    found_.curve = *task_.nodes;
    hold_corners();
    found_.points = task_.scattered;
    found_.way = task_.way;
    set_bounds(task_, found_);
    find_places(found_.curve, found_.points);
    descent_.begin_grid();
    if (task_.rms > 0)
      go_to_rms();
    else
      descent_.go();
    measure();
    return std::move(found_);
  }

  /// Moves corners to their places, and then holds them. Nodes do not move along the curve, so corners cannot go far on
  /// one grid.
  void place_corners() {
    descent_.has_sides = task_.within > 0;
    if (descent_.has_sides) descent_.data_weight = weight_of_sides();
    for (int grid = 0; grid < grids_of_corners; ++grid) {
      descent_.begin_grid();
      if (descent_.has_sides && grid == 0) descent_.nothing_left = next_to_no_energy * descent_.merit();
      if (task_.rms > 0)
        go_to_rms();
      else
        descent_.go(most_steps_of_corners);
      take_new_nodes(found_, with_new_nodes(found_.curve, least_spacing(task_)));
    }
    hold_corners();
  }

  void hold_corners() {
    for (std::uint32_t i = 0; i < found_.curve.size(); ++i) {
      if (found_.curve.node(i).corner) found_.curve.hold(i);
    }
  }

  [[nodiscard]] double rms() const {
    const auto all = squares([](const CurvePoint&) { return true; });
    return all.weights > 0 ? std::sqrt(all.sum / all.weights) : 0;
  }

  struct Squares {
    double sum = 0;
    double weights = 0;
  };

  /// The root mean square distance of points that count.
  template <typename Counts>
  [[nodiscard]] Squares squares(Counts counts) const {
    Squares result;
    for (const CurvePoint& point : found_.points) {
      if (!counts(point)) continue;
      result.sum += point.weight * found_.curve.offset(point.at, point.place).squaredNorm();
      result.weights += point.weight;
    }
    return result;
  }

  /// The root mean square to reach over all points. It is larger than asked for if otherwise the points that can be
  /// moved would have to follow their noise to make up for the others.
  [[nodiscard]] double rms_to_reach() const {
    const Squares at_held = squares([&](const CurvePoint& point) { return found_.curve.is_at_held(point.at); });
    const double weights = weight();
    const double wanted = task_.rms * task_.rms;
    const double left = wanted * weights - at_held.sum;
    const double movable = weights - at_held.weights;
    if (left >= std::pow(least_share_of_rms, 2) * wanted * movable) return task_.rms;
    return std::sqrt((wanted * movable + at_held.sum) / weights);
  }

  [[nodiscard]] double weight() const {
    double weights = 0;
    for (const CurvePoint& point : found_.points) weights += point.weight;
    return weights;
  }

  /// The weight at which a wave of the whole length keeps half of its height.
  [[nodiscard]] double weight_of_wave() const {
    const double length = length_of(found_.curve);
    return std::pow(2 * std::numbers::pi / length, 6) * length / weight();
  }

  /// A weight that is much smaller than that of bending, which is much smaller than that of change of curvature: so
  /// straight sides pass through the middle of their points.
  [[nodiscard]] double weight_of_sides() const {
    const double length = length_of(found_.curve);
    return next_to_no_weight * CurveDescent<K>::tie_break * std::pow(2 * std::numbers::pi / length, 4) * length /
           weight();
  }

  /// Finds the least weight with which points are near enough. Starts from the fairest curve that has no point much
  /// further away: with small weights alone a curve may go anywhere.
  void go_to_rms() {
    if (descent_.data_weight == 0) {
      for (CurvePoint& point : found_.points) {
        const double away = found_.curve.offset(point.at, point.place).norm();
        point.bound = std::max(reach_of_rms * task_.rms, CurveDescent<K>::loosened * away);
      }
      descent_.go();
      for (CurvePoint& point : found_.points) point.bound = 0;
      if (rms() <= rms_to_reach()) return;
      // Equal to the energy.
      const double of_wave = weight_of_wave();
      descent_.data_weight = std::max(descent_.merit() / (weight() * std::pow(task_.rms, 2)), of_wave);
      least_weight_ = next_to_no_weight * of_wave;
    }
    const double wanted = rms_to_reach();
    double near = 0;
    double far = 0;
    CurveFound best = found_;
    const auto go_back = [&] {
      const int steps = found_.steps;
      found_ = best;
      found_.steps = steps;
    };
    for (int trial = 0; trial < most_trials_of_weight && descent_.spent() < task_.most_work; ++trial) {
      descent_.go();
      const double figure = rms();
      if (figure <= wanted) {
        near = descent_.data_weight;
        best = found_;
        if (figure >= near_rms * wanted || (far > 0 && near < near_weight * far)) break;
        // A curve without energy is nearer than it needs to be.
        if (descent_.data_weight < least_weight_) {
          best.converged = true;
          break;
        }
      } else {
        far = descent_.data_weight;
        if (near == 0)
          best = found_;
        else
          go_back();
      }
      if (near > 0 && far > 0)
        descent_.data_weight = std::sqrt(near * far);
      else
        descent_.data_weight *= near > 0 ? 1 / stride_of_weight : stride_of_weight;
    }
    if (near > 0) descent_.data_weight = near;
    go_back();
  }

  /// Adds nodes where edges turn much; returns false if none do, or if there is not work enough for so many. spent: on
  /// the present ones.
  bool refine(std::size_t spent) {
    DenseCurve now = with_new_nodes(found_.curve, least_spacing(task_));
    if (now.size() <= found_.curve.size() + found_.curve.size() / 20) return false;
    const double share = static_cast<double>(now.size()) / static_cast<double>(found_.curve.size());
    if (static_cast<double>(descent_.spent()) + share * static_cast<double>(spent) >
        static_cast<double>(task_.most_work))
      return false;
    take_new_nodes(found_, std::move(now));
    return true;
  }

  void measure() {
    found_.rms = rms();
    found_.work = descent_.spent();
    for (const CurvePoint& point : found_.points)
      found_.greatest = std::max(found_.greatest, found_.curve.offset(point.at, point.place).norm());
    found_.beyond = descent_.measured_excess();
  }

  const CurveFitTask& task_;
  const std::function<void(double)>& progress_;
  CurveDescent<K> descent_;
  CurveFound& found_;
  double least_weight_ = 0;
};

}  // namespace

CurveFound fit_curve(const CurveFitTask& task, const std::function<void(double share)>& progress) {
  return task.plane ? CurveFitter<1>(task, progress).run() : CurveFitter<2>(task, progress).run();
}

}  // namespace vspring
