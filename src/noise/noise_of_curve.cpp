#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "fairness/curve_runs.hpp"
#include "noise/noisy_places.hpp"
#include "shape/planarity.hpp"
#include "vspring/error.hpp"
#include "vspring/noise.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_in_a_row = 7;
constexpr std::size_t most_in_a_row = 127;
constexpr std::size_t fewest_places = 16;
// Least length of a run, in standard deviations of the heights over it.
constexpr double long_way = 4;
constexpr double flatness = 1e-3;
// In units of the noise: rows so near to the one before are repeats, if there are more than by chance (one in sixty, or
// in seven with noise in one direction alone).
constexpr double same_again = 0.25;
constexpr double more_than_by_chance = 0.2;
// The share of steps below a long step; repeats are searched among steps shorter by up to so many factors of two.
constexpr double long_steps = 0.9;
constexpr int halvings = 14;
// The share across the curve that a coordinate must have for a place to tell its noise; then the least share, and the
// least number, of such places.
constexpr double least_across = 0.5;
constexpr double least_share_across = 0.2;
constexpr std::size_t least_across_places = 50;
// The ratio of the largest to the smallest noise of a coordinate above which they differ by more than chance.
constexpr double evident_ratio = 2;
constexpr int turns_of_coordinates = 5;
// Least variance, as a share of the largest, to avoid division by zero.
constexpr double least_share = 1e-6;

/// Noise across a stretch of curve, by coordinate.
struct Stretch {
  Vector3 squares = Vector3::Zero();                 ///< mean squares of the residuals of a quartic
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();  ///< the projection across the curve
  double freedom = 0;                                ///< of one direction
};

struct Stretches {
  std::vector<NoisyPlace> places;
  std::vector<Stretch> stretches;
  std::vector<double> steps;
};

Stretches stretches_of(const PolygonCurve& curve, int directions) {
  Stretches found;
  std::vector<Vector3> places;
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    const auto at = [&](std::size_t k) -> const Vector3& { return curve.position(chain.nodes[k % count]); };
    for (std::size_t k = 0; k + 1 < count + (chain.closed ? 1 : 0); ++k)
      found.steps.push_back((at(k + 1) - at(k)).norm());
    if (count < nodes_in_a_row) continue;
    for (std::size_t k = 0; k < (chain.closed ? count : count - nodes_in_a_row + 1); ++k) {
      end_if_cancelled_at(k);
      std::optional<NoisyPlace> best;
      places.clear();
      // Runs are lengthened until their direction is clear.
      for (std::size_t row = nodes_in_a_row; row <= most_in_a_row; row = 2 * row + 1) {
        if (chain.closed ? row > count : k + row > count) break;
        while (places.size() < row) places.push_back(at(k + places.size()));
        const auto heights = heights_of(places, {.axes = 1, .degree = 2, .directions = directions});
        if (!heights) {
          best.reset();
          continue;
        }
        best = NoisyPlace{heights->deviation, heights->freedom, heights->extents[1]};
        if (heights->extents[2] >= long_way * best->deviation) break;
      }
      if (!best) continue;
      found.places.push_back(*best);
      const auto heights = heights_of(places, {.axes = 1, .degree = 4, .directions = directions});
      if (!heights) continue;
      Stretch stretch;
      for (int direction = 0; direction < directions; ++direction) {
        const Vector3 axis = heights->axes.col(1 - direction);
        stretch.across += axis * axis.transpose();
        stretch.squares += heights->squares[1 - direction] * axis.cwiseAbs2();
      }
      stretch.freedom = heights->freedom / directions;
      found.stretches.push_back(stretch);
    }
  }
  return found;
}

/// The variances of the noise of each coordinate, from stretches where the curve runs across it. A quartic follows
/// bends that a quadratic would take for noise, often all on one side of a shape. 0 if there is too little data.
Vector3 variances_by_coordinate(const std::vector<Stretch>& stretches) {
  std::array<std::vector<std::size_t>, 3> across;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (stretches[k].across(axis, axis) >= least_across) across[static_cast<std::size_t>(axis)].push_back(k);
    }
  }
  for (auto& ones : across) {
    const bool is_enough =
        ones.size() >= least_across_places &&
        static_cast<double>(ones.size()) >= least_share_across * static_cast<double>(stretches.size());
    if (!is_enough) ones.clear();
  }
  Vector3 variances = Vector3::Ones();
  for (int turn = 0; turn < turns_of_coordinates; ++turn) {
    Vector3 next = Vector3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<NoisyPlace> places;
      for (const std::size_t k : across[static_cast<std::size_t>(axis)]) {
        const Stretch& stretch = stretches[k];
        // The part of the noise of all coordinates along this axis, in units of this one's variance.
        const double seen = stretch.across.row(axis).cwiseAbs2().dot(variances) / variances[axis];
        places.push_back({std::sqrt(stretch.squares[axis] / seen), stretch.freedom});
      }
      if (!places.empty()) next[axis] = std::pow(deviation_of(places), 2);
    }
    const double most = next.maxCoeff();
    if (!(most > 0)) return Vector3::Zero();
    // Unknown ones are taken to have as much.
    for (int axis = 0; axis < 3; ++axis)
      variances[axis] =
          across[static_cast<std::size_t>(axis)].empty() ? most : std::max(next[axis], least_share * most);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (across[static_cast<std::size_t>(axis)].empty()) variances[axis] = 0;
  }
  return variances;
}

/// Whether the known ones differ by more than chance.
bool differ(const Vector3& variances) {
  const double most = variances.maxCoeff();
  return most > 0 && (variances.array() > 0 && variances.array() < most / (evident_ratio * evident_ratio)).any();
}

/// The curve without nodes nearer than `distance` to the one before.
PolygonCurve without_near_ones(const PolygonCurve& curve, double distance) {
  std::vector<PolygonCurve::Chain> chains;
  for (const auto& chain : curve.chains()) {
    PolygonCurve::Chain kept{.nodes = {}, .closed = chain.closed};
    for (const Index node : chain.nodes) {
      if (kept.nodes.empty() || (curve.position(node) - curve.position(kept.nodes.back())).norm() >= distance)
        kept.nodes.push_back(node);
    }
    if (kept.nodes.size() >= nodes_in_a_row) chains.push_back(std::move(kept));
  }
  return {curve.positions(), std::move(chains)};
}

std::size_t visited(const PolygonCurve& curve) {
  std::size_t nodes = 0;
  for (const auto& chain : curve.chains()) nodes += chain.nodes.size();
  return nodes;
}

/// Rows repeated a little apart would look like a curve without noise. Removes them if the noise of the rest explains
/// their distance; nothing if there are none.
std::optional<Stretches> without_repeats(const PolygonCurve& curve, std::vector<double> steps, int directions) {
  if (steps.empty()) return std::nullopt;
  double distance = value_at_share(steps, long_steps);
  for (int turn = 0; turn < halvings; ++turn) {
    distance /= 2;
    const PolygonCurve fewer = without_near_ones(curve, distance);
    const auto most = (1 - more_than_by_chance) * static_cast<double>(visited(curve));
    if (static_cast<double>(visited(fewer)) > most) return std::nullopt;
    Stretches found = stretches_of(fewer, directions);
    if (distance <= same_again * noise_of_places(found.places, found.steps, 0).deviation) return found;
  }
  return std::nullopt;
}

}  // namespace

NoiseEstimate estimate_noise(const PolygonCurve& whole_curve) {
  const PolygonCurve curve = visible_part(whole_curve);
  const int directions = plane_normal(curve.positions()) ? 1 : 2;
  Stretches found = stretches_of(curve, directions);
  if (auto fewer = without_repeats(curve, found.steps, directions)) found = std::move(*fewer);
  // A few runs that share their rows show bends as much as noise.
  if (found.places.size() < fewest_places) return {.directions = directions};
  NoiseEstimate estimate = noise_of_places(std::move(found.places), std::move(found.steps), 0);
  estimate.directions = directions;
  const Vector3 variances = variances_by_coordinate(found.stretches);
  for (int axis = 0; axis < 3; ++axis)
    estimate.by_coordinate[static_cast<std::size_t>(axis)] = std::sqrt(variances[axis]);
  estimate.coordinates_differ = differ(variances);
  if (estimate.coordinates_differ) {
    double squares = 0;
    for (const Stretch& stretch : found.stretches) squares += stretch.across.diagonal().dot(variances) / directions;
    const double deviation = std::sqrt(squares / static_cast<double>(found.stretches.size()));
    estimate.edges *= estimate.deviation > 0 ? deviation / estimate.deviation : 0;
    estimate.deviation = deviation;
  }
  forget_rounding(estimate, curve.positions());
  return estimate;
}

NoiseEstimate estimate_noise(const PolygonCurve& curve, const std::array<bool, 3>& moving_axes) {
  if (moving_axes == std::array{true, true, true}) return estimate_noise(curve);
  // So flat that all moving coordinates are across it.
  std::vector<Vector3> flat(curve.positions().size(), Vector3::Zero());
  std::vector<PolygonCurve::Chain> chains = curve.chains();
  for (auto& chain : chains) {
    double way = 0;
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
      const Vector3 step = curve.position(chain.nodes[k]) - curve.position(chain.nodes[k > 0 ? k - 1 : 0]);
      Vector3& place = flat[static_cast<std::size_t>(chain.nodes[k])];
      double squares = 0;
      int moving = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (moving_axes[static_cast<std::size_t>(axis)])
          place[1 + moving++ % 2] = flatness * curve.position(chain.nodes[k])[axis];
        else
          squares += step[axis] * step[axis];
      }
      way += std::sqrt(squares);
      place.x() = way;
    }
    chain.closed = false;
  }
  NoiseEstimate estimate = estimate_noise(PolygonCurve(std::move(flat), std::move(chains)));
  estimate.deviation /= flatness;
  estimate.edges /= flatness;
  const std::array<double, 3> found = estimate.by_coordinate;
  for (std::size_t axis = 0, moving = 0; axis < 3; ++axis)
    estimate.by_coordinate[axis] = moving_axes[axis] ? found[1 + moving++ % 2] / flatness : 0;
  return estimate;
}

NoiseEstimate estimate_noise(const PolygonCurve& curve, std::span<const Index> region,
                             const std::array<bool, 3>& moving_axes) {
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(curve.node_count()), 0);
  for (const Index node : region) {
    if (node < 0 || node >= curve.node_count())
      throw Error(ErrorCode::invalid_argument, "region: no node " + std::to_string(node));
    inside[static_cast<std::size_t>(node)] = 1;
  }
  const auto is_inside = [&](Index node) { return inside[static_cast<std::size_t>(node)] != 0; };
  std::vector<PolygonCurve::Chain> pieces;
  for (const auto& chain : curve.chains()) {
    if (std::all_of(chain.nodes.begin(), chain.nodes.end(), is_inside)) {
      pieces.push_back(chain);
      continue;
    }
    // A closed chain begins where it comes into the region.
    std::vector<Index> nodes = chain.nodes;
    if (chain.closed) std::rotate(nodes.begin(), std::find_if_not(nodes.begin(), nodes.end(), is_inside), nodes.end());
    bool goes_on = false;
    for (const Index node : nodes) {
      if (is_inside(node)) {
        if (!goes_on) pieces.push_back({.nodes = {}, .closed = false});
        pieces.back().nodes.push_back(node);
      }
      goes_on = is_inside(node);
    }
  }
  std::erase_if(pieces, [](const auto& piece) { return piece.nodes.size() < nodes_in_a_row; });
  NoiseEstimate estimate;
  if (!pieces.empty()) estimate = estimate_noise(PolygonCurve(curve.positions(), std::move(pieces)), moving_axes);
  return estimate.nodes > 0 ? estimate : estimate_noise(curve, moving_axes);
}

}  // namespace vspring
