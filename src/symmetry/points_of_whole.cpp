#include "symmetry/points_of_whole.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <type_traits>
#include <variant>
#include <vector>

#include "symmetry/reach.hpp"
#include "vspring/error.hpp"
#include "vspring/noise.hpp"

namespace vspring {

namespace {

// The share of a tolerance that must be left beside the asymmetry of a whole's nodes.
constexpr double least_share_left = 0.25;

/// How far the nodes of a whole are from the means of their pairs across the curve.
std::vector<double> asymmetry(const Symmetric<PolygonCurve>& shape) {
  std::vector<Index> nodes(shape.partner.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  const std::vector<Vector3> tangents = estimate_tangents(shape.whole, nodes);
  std::vector<double> across;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector3 off = shape.given.positions()[i] - shape.whole.positions()[i];
    across.push_back((off - off.dot(tangents[i]) * tangents[i]).norm());
  }
  return across;
}

double require_left(double left, double tolerance) {
  if (!(left >= least_share_left * tolerance))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the nodes are too far from being symmetric for a tolerance of {:.3g}: that of their mean "
                            "with their mirror images would be {:.3g}; allow more",
                            tolerance, std::max(left, 0.0)));
  return left;
}

double noise_in(const PolygonMesh& mesh, const Context& context) { return estimate_noise(mesh, context).deviation; }
double noise_in(const PolygonCurve& curve, const Context& /*context*/) { return estimate_noise(curve).deviation; }

/// The criterion for the means of pairs, which have less noise than the nodes, and are away from them.
template <typename Shape>
FitCriterion criterion_of_means(const Symmetric<Shape>& shape, const FitCriterion& criterion, const Context& context) {
  if (const auto* const noise = std::get_if<Noise>(&criterion)) {
    const double before = noise_in(shape.given, context);
    const double after = noise_in(shape.whole, context);
    const bool known = before > 0 && after > 0;
    return Noise{noise->deviation * (known ? std::clamp(after / before, std::numbers::sqrt2 / 2, 1.0) : 1)};
  }
  if constexpr (std::is_same_v<Shape, PolygonCurve>) {
    const std::vector<double> off = asymmetry(shape);
    if (const auto* const within = std::get_if<Within>(&criterion))
      return Within{require_left(within->distance - *std::max_element(off.begin(), off.end()), within->distance)};
    if (const auto* const rms = std::get_if<RootMeanSquare>(&criterion)) {
      const double squares = std::inner_product(off.begin(), off.end(), off.begin(), 0.0);
      const double left = rms->distance * rms->distance - squares / static_cast<double>(off.size());
      return RootMeanSquare{require_left(std::sqrt(std::max(left, 0.0)), rms->distance)};
    }
  }
  return criterion;
}

/// Appends the mirror images of the points that lie off the plane, and those of their weights and normals.
template <typename Shape>
ScatteredPoints with_images(const Symmetric<Shape>& shape, const ScatteredPoints& points, GivenNumbers& numbers) {
  ScatteredPoints both = points;
  const double near = nearness_on_plane(shape);
  for (std::size_t j = 0; j < points.positions.size(); ++j) {
    if (std::abs(shape.plane.distance(points.positions[j])) <= near) continue;
    numbers.points_with_image.push_back(static_cast<Index>(j));
    both.positions.push_back(shape.plane.mirrored(points.positions[j]));
    if (!points.weights.empty()) both.weights.push_back(points.weights[j]);
    if (!points.normals.empty()) both.normals.push_back(shape.plane.mirrored_direction(points.normals[j]));
  }
  return both;
}

/// The nodes of the whole, with the weights and normals of the given ones. Half: also of the mirror images.
template <typename Shape>
ScatteredPoints nodes_of_whole(const Symmetric<Shape>& shape, const ScatteredPoints& points, GivenNumbers& numbers) {
  ScatteredPoints nodes = points;
  nodes.positions = shape.whole.positions();
  for (std::size_t i = points.positions.size(); i < nodes.positions.size(); ++i) {
    const auto of = static_cast<std::size_t>(shape.partner[i]);
    numbers.points_with_image.push_back(shape.partner[i]);
    if (!points.weights.empty()) nodes.weights.push_back(points.weights[of]);
    if (!points.normals.empty()) nodes.normals.push_back(shape.plane.mirrored_direction(points.normals[of]));
  }
  return nodes;
}

}  // namespace

template <typename Shape>
PointsOfWhole points_of_whole(const Symmetric<Shape>& shape, const ScatteredPoints& points,
                              const FitCriterion& criterion, const Context& context, GivenNumbers& numbers) {
  const bool own_nodes = points.positions == shape.given.positions();
  if (!own_nodes) return {with_images(shape, points, numbers), criterion, own_nodes};
  if (shape.is_half) return {nodes_of_whole(shape, points, numbers), criterion, own_nodes};
  // A surface is drawn to both nodes of a pair; a curve needs its nodes in their order.
  const bool has_tolerance =
      std::holds_alternative<Within>(criterion) || std::holds_alternative<RootMeanSquare>(criterion);
  if (std::is_same_v<Shape, PolygonMesh> && has_tolerance) {
    ScatteredPoints both = points;
    both.weights.resize(points.positions.size(), 1);
    for (std::size_t i = 0; i < both.weights.size(); ++i) both.weights[i] *= shape.partner[i] < 0 ? 0 : 1;
    return {with_images(shape, both, numbers), criterion, own_nodes};
  }
  return {nodes_of_whole(shape, points, numbers), criterion_of_means(shape, criterion, context), own_nodes};
}

template PointsOfWhole points_of_whole(const Symmetric<PolygonMesh>&, const ScatteredPoints&, const FitCriterion&,
                                       const Context&, GivenNumbers&);
template PointsOfWhole points_of_whole(const Symmetric<PolygonCurve>&, const ScatteredPoints&, const FitCriterion&,
                                       const Context&, GivenNumbers&);

}  // namespace vspring
