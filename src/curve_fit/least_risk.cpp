#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "curve_fit/curve_start.hpp"
#include "curve_fit/smoothing_spline.hpp"

namespace vspring {

namespace {

constexpr double fine_stride = 0.3;
// Strides to either side of the smoothing of a similar curve.
constexpr int strides_about = 6;
// Most parameters, as a share of the number of points.
constexpr double most_freedom = 0.9;
// How many times parameters count for the risk: more than once, as noise may exceed its estimate, and a curve that
// follows it even slightly has many bends.
constexpr double caution = 3;

/// Per point its share of the parameters of the spline with a smoothing of 1. Their density is (weight over the length
/// that the point represents)^(1/6) / 3 (Silverman 1984).
std::vector<double> shares_of_freedom(const SmoothingSpline& spline) {
  const DenseCurve& curve = spline.curve();
  std::vector<double> begins(curve.size() + 1, 0);
  for (std::uint32_t i = 0; i < curve.size(); ++i)
    begins[i + 1] = begins[i] + (curve.is_edge(i) ? curve.edge_length(i) : 0);
  std::vector<std::pair<double, double>> places;
  double weights = 0;
  for (const CurvePoint& point : spline.points()) {
    if (!(point.weight > 0)) continue;
    const std::uint32_t edge = point.at.edge;
    places.emplace_back(begins[edge] + point.at.share * (begins[edge + 1] - begins[edge]), point.weight);
    weights += point.weight;
  }
  std::sort(places.begin(), places.end());
  std::vector<double> shares;
  for (std::size_t j = 0; j < places.size(); ++j) {
    const double from = j > 0 ? places[j - 1].first : 0;
    const double to = j + 1 < places.size() ? places[j + 1].first : spline.length();
    const double length = (to - from) / 2 / spline.length();
    shares.push_back(std::pow(places[j].second / weights, 1.0 / 6) * std::pow(length, 5.0 / 6) / 3);
  }
  return shares;
}

/// The effective number of parameters of the spline, in each coordinate; at most one per point.
double freedom(const std::vector<double>& shares, double smoothing) {
  const double density = std::pow(smoothing, -1.0 / 6);
  double sum = 0;
  for (const double share : shares) sum += std::min(1.0, share * density);
  return sum;
}

/// Directions of the old curve at the places of points; zero for coordinates that stay.
std::vector<Vector3> directions_at_points(const SmoothingSpline& spline) {
  std::vector<Vector3> directions(spline.points().size(), Vector3::Zero());
  for (std::size_t j = 0; j < directions.size() && spline.curve().moves_freely(); ++j)
    directions[j] = spline.curve().direction(spline.points()[j].at);
  return directions;
}

/// The mean square of distances of points from their places, across the curve.
double mean_square_across(const SmoothingSpline& spline, const std::vector<Vector3>& along) {
  double squares = 0;
  double weights = 0;
  for (std::size_t j = 0; j < along.size(); ++j) {
    Vector3 away = spline.residual(j);
    away -= away.dot(along[j]) * along[j];
    squares += spline.points()[j].weight * away.squaredNorm();
    weights += spline.points()[j].weight;
  }
  return squares / weights;
}

}  // namespace

LeastRisk smooth_out_by_risk(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise, int directions,
                             double about) {
  SmoothingSpline spline(curve, points);
  double least = std::numeric_limits<double>::infinity();
  LeastRisk found;
  std::vector<Vector3> best;
  const auto pulls = [](const CurvePoint& point) { return point.weight > 0; };
  const auto count = static_cast<double>(std::count_if(points.begin(), points.end(), pulls));
  const std::vector<double> shares = shares_of_freedom(spline);
  const std::vector<Vector3> along = directions_at_points(spline);
  const double far = std::pow(fine_stride, strides_about);
  const double first = about > 0 ? std::min(about / far, first_smoothing) : first_smoothing;
  double smoothing = first / fine_stride;
  while (smoothing > std::max(least_smoothing, about > 0 ? far * found.smoothing : 0)) {
    smoothing *= fine_stride;
    end_if_cancelled();
    const double freedom = vspring::freedom(shares, smoothing);
    const double spread = 2 * caution * noise * noise * freedom / count;
    // A spline that follows every point shows nothing.
    if (freedom > most_freedom * count || spread > least) break;
    if (!spline.solve(smoothing)) continue;
    const double square = mean_square_across(spline, along);
    const double risk = square / directions + spread;
    if (!(risk < least) || !spline.is_sane()) continue;
    least = risk;
    found = {std::sqrt(square), smoothing};
    best = spline.places();
  }
  // Less smoothing may be better.
  if (found.smoothing == first && first < first_smoothing)
    return smooth_out_by_risk(curve, points, noise, directions, 0);
  spline.set_places(std::move(best));
  spline.take();
  return found;
}

}  // namespace vspring
