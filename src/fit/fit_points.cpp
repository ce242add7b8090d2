#include "fit/fit_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "io/point_formats.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// As a share of a tolerance: points further away are at it.
constexpr double nearly_at = 0.99;

bool is_weight(double weight) { return weight >= 0 && weight <= largest_weight; }

/// Nothing where another criterion is given.
template <typename Criterion>
std::optional<double> figure_of(const FitCriterion& criterion, double Criterion::*figure) {
  if (const auto* const given = std::get_if<Criterion>(&criterion)) return given->*figure;
  return std::nullopt;
}

void refuse_what_bars(const char* what, const FairOptions& fair) {
  if (fair.method_kind() != Method::equilibrium)
    throw Error(ErrorCode::invalid_argument, fmt::format("{} can be kept by the method equilibrium only, not by {}",
                                                         what, name(fair.method_kind())));
  if (fair.strength < 1)
    throw Error(ErrorCode::invalid_argument, fmt::format("{} can be kept at full strength only", what));
}

}  // namespace

void check_points(const ScatteredPoints& points, const std::vector<Vector3>& nodes) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  const std::size_t count = points.positions.size();
  if (count == 0) refuse("there are no points to fit to");
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    refuse(fmt::format("{} points are too many: {} is the most", count, std::numeric_limits<Index>::max()));
  if (!points.weights.empty() && points.weights.size() != count)
    refuse(fmt::format("{} weights are given for {} points: one for each is needed, or none", points.weights.size(),
                       count));
  for (std::size_t j = 0; j < count; ++j) {
    if (points.positions[j].allFinite()) continue;
    const bool is_node = nodes.size() == count && !nodes[j].allFinite();
    throw Error(ErrorCode::unusable_shape,
                fmt::format("{} {}: a coordinate is not finite", is_node ? "node" : "point", j),
                {{Remedy::input, is_node ? "correct it" : "leave it out"}});
  }
  if (!points.normals.empty() && points.normals.size() != count)
    refuse(fmt::format("{} normals are given for {} points: one for each is needed, or none", points.normals.size(),
                       count));
  for (std::size_t j = 0; j < points.normals.size(); ++j) {
    if (!is_point_normal(points.normals[j]))
      refuse(
          fmt::format("the normal of point {} has the length {:.4g}; it must be 1, or 0 where it is not known; "
                      "correct it, or leave normals out",
                      j, points.normals[j].norm()));
  }
  for (std::size_t j = 0; j < points.weights.size(); ++j) {
    if (!is_weight(points.weights[j]))
      refuse(
          fmt::format("the weight of point {} must be from 0 to {:g}, not {}", j, largest_weight, points.weights[j]));
  }
}

std::vector<std::uint8_t> without_furthest(std::span<const double> distances, double share, double least) {
  std::vector<std::uint32_t> order(distances.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto count = static_cast<std::ptrdiff_t>(std::floor(share * static_cast<double>(distances.size())));
  std::nth_element(order.begin(), order.begin() + count, order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distances[a] > distances[b] || (distances[a] == distances[b] && a < b);
  });
  std::vector<std::uint8_t> kept(distances.size(), 1);
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const std::uint32_t point = order[static_cast<std::size_t>(k)];
    if (distances[point] > least) kept[point] = 0;
  }
  return kept;
}

std::vector<Index> left_out(std::span<const std::uint8_t> counted, std::span<const std::uint8_t> kept) {
  std::vector<Index> points;
  for (std::size_t j = 0; j < counted.size(); ++j) {
    if (counted[j] != 0 && kept[j] == 0) points.push_back(static_cast<Index>(j));
  }
  return points;
}

std::vector<Index> active_points(std::span<const double> distances, std::span<const std::uint8_t> counted,
                                 double distance) {
  std::vector<Index> active;
  for (std::size_t j = 0; j < distances.size(); ++j) {
    if ((counted.empty() || counted[j] != 0) && distances[j] > nearly_at * distance)
      active.push_back(static_cast<Index>(j));
  }
  return active;
}

Index count_beyond(std::span<const double> distances, std::span<const std::uint8_t> counted, double distance) {
  Index count = 0;
  for (std::size_t j = 0; j < distances.size(); ++j) count += counted[j] != 0 && distances[j] > distance ? 1 : 0;
  return count;
}

PointDistances summary(std::span<const double> distances, std::span<const std::uint8_t> counted) {
  PointDistances result;
  Distance& all = result.all;
  std::vector<double> those;
  for (std::size_t j = 0; j < distances.size(); ++j) {
    if (counted[j] == 0) continue;
    if (those.empty() || distances[j] > all.greatest) {
      all.greatest = distances[j];
      all.node = static_cast<Index>(j);
    }
    those.push_back(distances[j]);
  }
  if (those.empty()) return result;
  all.count = static_cast<Index>(those.size());
  double squares = 0;
  for (const double distance : those) {
    const double share = all.greatest > 0 ? distance / all.greatest : 0;
    squares += share * share;
  }
  all.rms = all.greatest * std::sqrt(squares / static_cast<double>(those.size()));
  const auto percentile = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(those.size())));
    const auto place = those.begin() + rank - 1;
    std::nth_element(those.begin(), place, those.end());
    return *place;
  };
  result.median = percentile(0.5);
  result.percentile90 = percentile(0.9);
  result.percentile99 = percentile(0.99);
  return result;
}

std::optional<double> FitOptions::weight() const { return figure_of(criterion, &Weight::k); }
std::optional<double> FitOptions::smoothing_length() const { return figure_of(criterion, &SmoothingLength::length); }
std::optional<double> FitOptions::within() const { return figure_of(criterion, &Within::distance); }
std::optional<double> FitOptions::rms() const { return figure_of(criterion, &RootMeanSquare::distance); }
std::optional<double> FitOptions::noise() const { return figure_of(criterion, &Noise::deviation); }
std::optional<Vector3> FitOptions::voxels() const {
  const auto* const given = std::get_if<Voxels>(&criterion);
  return given != nullptr ? std::optional(given->size) : std::nullopt;
}

std::optional<double> FitOptions::tolerance() const { return within() ? within() : rms(); }

void check_corners_kept(const FitOptions& options, const Constraints& constraints) {
  if (constraints.corner_count() > 0) refuse_what_bars("corners", options.fair);
}

bool has_corners(const FitOptions& options, const Constraints& constraints) {
  return options.sharp > 0 || !options.fair.corners.empty() || constraints.corner_count() > 0;
}

void FitOptions::validate() const {
  fair.validate();
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  if (fair.continuity == Continuity::curvature)
    refuse("a shape meets the curvature of what is around it where no points pull; fair it after the fit");
  if (weight() && !is_weight(*weight()))
    refuse(fmt::format("weight must be from 0 to {:g}, not {}", largest_weight, *weight()));
  const auto check_length = [&](const char* option, const std::optional<double>& length) {
    if (length && !(*length > 0 && std::isfinite(*length)))
      refuse(fmt::format("{} must be more than 0, not {}", option, *length));
  };
  check_length("smoothing length", smoothing_length());
  check_length("within", within());
  check_length("rms", rms());
  check_length("noise", noise());
  for (int axis = 0; voxels() && axis < 3; ++axis) check_length("size of voxels", (*voxels())[axis]);
  if (voxels() && fair.method_kind() != Method::equilibrium)
    refuse(fmt::format("steps of voxels are taken off by the method equilibrium only, not by {}",
                       name(fair.method_kind())));
  if (!(outliers >= 0 && outliers < 1)) refuse(fmt::format("outliers must be from 0 to less than 1, not {}", outliers));
  if (!(least_radius >= 0 && std::isfinite(least_radius)))
    refuse(fmt::format("least radius must be 0 or more, not {}", least_radius));
  if (!(boundary_reach >= 0 && std::isfinite(boundary_reach)))
    refuse(fmt::format("reach of the boundary must be 0 or more, not {}", boundary_reach));
  if (!(sharp >= 0 && sharp < 180))
    refuse(fmt::format("sharp must be an angle from 0 to less than 180 degrees, not {}", sharp));
  if (least_radius > 0) refuse_what_bars("a least radius", fair);
  if (sharp > 0 || !fair.corners.empty()) refuse_what_bars("corners", fair);
  const bool is_amount = tolerance() || noise();
  if (is_amount && fair.method_kind() != Method::equilibrium)
    refuse(fmt::format("points can be fitted to a tolerance by the method equilibrium only, not by {}",
                       name(fair.method_kind())));
  if (moving_axes == std::array{false, false, false}) refuse("no coordinate moves: let one of x, y and z");
  if (!moves_freely() && fair.method_kind() != Method::equilibrium)
    refuse(fmt::format("coordinates can be kept by the method equilibrium only, not by {}", name(fair.method_kind())));
  if (is_amount && fair.strength < 1) refuse("points can be fitted to a tolerance at full strength only");
}

}  // namespace vspring
