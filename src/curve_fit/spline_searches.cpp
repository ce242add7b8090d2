#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancellation.hpp"
#include "base/median.hpp"
#include "curve_fit/curve_start.hpp"
#include "curve_fit/smoothing_spline.hpp"
#include "noise/noisy_places.hpp"

namespace vspring {

namespace {

constexpr double coarse_stride = 1e-2;
constexpr int halvings = 5;
// This share of the points may be outside, by this factor of the tolerance: near held nodes some are, and would make
// the whole curve follow noise.
constexpr double share_outside = 0.1;
constexpr double most_outside = 2;
// In root mean squares.
constexpr double reach_of_rms_at_first = 2.5;
constexpr double more_turning = 0.5;
constexpr double robust_stride = 0.1;
constexpr int robust_turns = 6;
constexpr int most_turns_drawing_in = 8;

/// The squared distance of a point; if some coordinates stay, from its place.
double squared_distance(const SmoothingSpline& spline, std::size_t point) {
  return spline.curve().moves_freely() ? spline.squared_distance(point) : spline.squared_residual(point);
}

bool is_near(const SmoothingSpline& spline, double within, double rms) {
  double squares = 0;
  double outside = 0;
  double weights = 0;
  for (std::size_t j = 0; j < spline.points().size(); ++j) {
    const CurvePoint& point = spline.points()[j];
    if (!(point.weight > 0)) continue;
    // Where the way comes back, the nearest place may be on its other half.
    const double square = within > 0 ? spline.squared_residual(j) : squared_distance(spline, j);
    if (within > 0 && square > std::pow(most_outside * within, 2)) return false;
    outside += square > within * within ? point.weight : 0;
    // Other points would have to follow their noise to make up for it.
    if (!(within > 0) && spline.curve().is_at_held(point.at)) continue;
    squares += point.weight * square;
    weights += point.weight;
  }
  return within > 0 ? outside <= share_outside * weights : squares <= weights * rms * rms;
}

/// Increases the weights of points too far away until they are near enough or the curve turns more: this extends tips,
/// but makes no loops for rows without order.
void draw_in(SmoothingSpline& spline, double within, double rms, double smoothing) {
  const double most = within > 0 ? within : reach_of_rms_at_first * rms;
  const double most_turning = spline.turning() + more_turning;
  for (int turn = 0; turn < most_turns_drawing_in; ++turn) {
    bool outside = false;
    for (std::size_t j = 0; j < spline.points().size(); ++j) {
      const double beyond = std::sqrt(squared_distance(spline, j)) / most;
      if (!(spline.points()[j].weight > 0) || beyond <= 1) continue;
      outside = true;
      spline.counts[j] *= std::pow(1 + beyond, 2);
    }
    if (!outside) return;
    spline.weigh();
    const std::vector<Vector3> before = spline.places();
    if (spline.solve(smoothing) && spline.is_sane() && spline.turning() <= most_turning) continue;
    spline.set_places(before);
    return;
  }
}

}  // namespace

void smooth_out(DenseCurve& curve, const std::vector<CurvePoint>& points, double within, double rms) {
  SmoothingSpline spline(curve, points);
  double smoothing = first_smoothing;
  double beyond = 0;
  std::vector<Vector3> sane;
  for (;; smoothing *= coarse_stride) {
    end_if_cancelled();
    if (!spline.solve(smoothing) || !spline.is_sane()) {
      // Robust splines of points far apart may go anywhere; takes the last sane one.
      if (!sane.empty()) {
        spline.set_places(std::move(sane));
        break;
      }
    } else {
      if (is_near(spline, within, rms)) break;
      sane = spline.places();
    }
    if (smoothing < least_smoothing) break;
    beyond = smoothing;
  }
  for (int k = 0; k < halvings && beyond > 0 && smoothing >= least_smoothing; ++k) {
    const double middle = std::sqrt(smoothing * beyond);
    const std::vector<Vector3> found = spline.places();
    if (spline.solve(middle) && spline.is_sane() && is_near(spline, within, rms)) {
      smoothing = middle;
    } else {
      beyond = middle;
      spline.set_places(found);
    }
  }
  if (smoothing >= least_smoothing) draw_in(spline, within, rms, smoothing);
  spline.take();
}

void smooth_out_by(DenseCurve& curve, const std::vector<CurvePoint>& points, double length) {
  SmoothingSpline spline(curve, points);
  double smoothing = std::min(std::pow(length / spline.length(), 6), first_smoothing);
  while (!(spline.solve(smoothing) && spline.is_sane()) && smoothing < first_smoothing) smoothing /= coarse_stride;
  spline.take();
}

void smooth_out_robustly(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise) {
  SmoothingSpline spline(curve, points);
  double smoothing = first_smoothing;
  while (smoothing > least_smoothing) {
    spline.counts.assign(points.size(), 1);
    spline.weigh();
    const std::vector<Vector3> before = spline.places();
    if (!spline.solve(smoothing) || !spline.is_sane()) {
      spline.set_places(before);
      break;
    }
    for (int turn = 0; turn < robust_turns; ++turn) {
      for (std::size_t j = 0; j < points.size(); ++j)
        spline.counts[j] = 1 / std::max(std::sqrt(spline.squared_residual(j)) / noise, 1.0);
      spline.weigh();
      (void)spline.solve(smoothing);
    }
    std::vector<double> distances;
    for (std::size_t j = 0; j < points.size(); ++j) distances.push_back(squared_distance(spline, j));
    if (std::sqrt(median(distances)) <= median_of_noise * noise) break;
    smoothing *= robust_stride;
  }
  spline.take();
}

}  // namespace vspring
