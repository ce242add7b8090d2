#include "noise/noisy_places.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/cancellation.hpp"
#include "base/dense_algebra.hpp"

namespace vspring {

namespace {

/// A share of the places, and the normal distribution's quantile there.
struct Share {
  double of_places;
  double quantile;
};
// Bends of the shape only increase heights, so each percentile bounds the noise from above, and the smallest estimate
// counts. Values below the first may be smoothed or filled parts.
constexpr Share shares[] = {{0.1, -1.2816}, {0.2, -0.8416}, {0.3, -0.5244}};
// The least share of places to use, and the number of rounds.
constexpr double least_share_wide = 0.2;
constexpr int most_turns = 5;
// The least degrees of freedom to use: of a quadratic in one direction, and of a quartic.
constexpr Eigen::Index least_freedom = 3;
constexpr Eigen::Index least_freedom_of_quartics = 2;
constexpr double least_pivot = 1e-5;
// As a share of the greatest coordinate.
constexpr double last_digits = 16 * std::numeric_limits<double>::epsilon();

/// The quantile of the mean square, over its degrees of freedom, of unit noise (E. B. Wilson, M. M. Hilferty, "The
/// distribution of chi-square", 1931).
double expected_square(double freedom, double quantile) {
  const double spread = 2 / (9 * freedom);
  const double root = 1 - spread + quantile * std::sqrt(spread);
  return root * root * root;
}

}  // namespace

double value_at_share(std::vector<double>& values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::optional<Heights> heights_of(std::span<const Vector3> points, const HeightForm& form) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index unknowns = form.axes == 2 ? 6 : form.degree + 1;
  if (count < unknowns + (form.degree == 2 ? least_freedom : least_freedom_of_quartics)) return std::nullopt;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points) centre += p / static_cast<double>(count);
  if (!centre.allFinite()) return std::nullopt;
  double size = 0;
  for (const Vector3& p : points) size = std::max(size, (p - centre).lpNorm<Eigen::Infinity>());
  if (!(size > 0)) return std::nullopt;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) spread += (p - centre) / size * ((p - centre) / size).transpose();
  Heights heights;
  heights.axes = principal_axes(spread);
  Eigen::MatrixXd matrix(count, unknowns);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector3 local = heights.axes.transpose() * (points[static_cast<std::size_t>(k)] - centre) / size;
    const double u = local[2];
    const double v = local[1];
    if (form.axes == 2)
      matrix.row(k) << 1, u, v, u * u, u * v, v * v;
    else if (form.degree == 2)
      matrix.row(k) << 1, u, u * u;
    else
      matrix.row(k) << 1, u, u * u, u * u * u, u * u * u * u;
  }
  double squares = 0;
  for (int direction = 0; direction < form.directions; ++direction) {
    const int across = form.axes == 2 ? 0 : 1 - direction;
    const auto axis = heights.axes.col(across);
    Eigen::VectorXd right(count);
    for (Eigen::Index k = 0; k < count; ++k) right[k] = axis.dot(points[static_cast<std::size_t>(k)] - centre) / size;
    const auto solution = least_squares(matrix, right, least_pivot);
    if (!solution) return std::nullopt;
    const double left = (matrix * *solution - right).squaredNorm();
    squares += left;
    heights.squares[across] = size * size * left / static_cast<double>(count - unknowns);
  }
  heights.freedom = static_cast<double>((count - unknowns) * form.directions);
  heights.deviation = size * std::sqrt(squares / heights.freedom);
  for (int axis = 0; axis < 3; ++axis) {
    const double square = heights.axes.col(axis).dot(spread * heights.axes.col(axis));
    heights.extents[axis] = size * std::sqrt(std::max(0.0, square) / static_cast<double>(count));
  }
  return heights;
}

double deviation_of(const std::vector<NoisyPlace>& places) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> deviations(places.size());
  for (const Share& one : shares) {
    end_if_cancelled();
    for (std::size_t k = 0; k < places.size(); ++k)
      deviations[k] = places[k].deviation / std::sqrt(expected_square(places[k].freedom, one.quantile));
    least = std::min(least, value_at_share(deviations, one.of_places));
  }
  return least;
}

NoiseEstimate noise_of_places(std::vector<NoisyPlace> places, std::vector<double> edges, double narrowest) {
  std::erase_if(places, [](const NoisyPlace& place) { return !std::isfinite(place.deviation); });
  std::erase_if(edges, [](double edge) { return !std::isfinite(edge); });
  NoiseEstimate result;
  if (places.empty() || edges.empty()) return result;
  result.nodes = static_cast<Index>(places.size());
  result.deviation = deviation_of(places);
  for (int turn = 0; turn < most_turns && narrowest > 0; ++turn) {
    std::vector<NoisyPlace> wide;
    std::copy_if(places.begin(), places.end(), std::back_inserter(wide),
                 [&](const NoisyPlace& place) { return place.extent >= narrowest * result.deviation; });
    if (static_cast<double>(wide.size()) < least_share_wide * static_cast<double>(places.size())) break;
    result.deviation = deviation_of(wide);
  }
  const double edge = value_at_share(edges, 0.5);
  result.edges = edge > 0 ? result.deviation / edge : 0;
  return result;
}

void forget_rounding(NoiseEstimate& noise, const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& position : positions) {
    if (position.allFinite()) greatest = std::max(greatest, position.cwiseAbs().maxCoeff());
  }
  if (noise.deviation >= last_digits * greatest) return;
  noise.deviation = noise.edges = 0;
  noise.by_coordinate = {};
  noise.coordinates_differ = false;
}

}  // namespace vspring
