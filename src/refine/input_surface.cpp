#include "refine/input_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>

#include "shape/face_geometry.hpp"
#include "shape/segment.hpp"
#include "shape/triangle_place.hpp"

namespace vspring {

namespace {

std::vector<Box> boxes_of(std::span<const Triangle> triangles, const std::vector<Vector3>& positions) {
  std::vector<Box> boxes(triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    for (const Index node : triangles[k].nodes) boxes[k].extend(positions[static_cast<std::size_t>(node)]);
  }
  return boxes;
}

std::vector<Box> boxes_of(std::span<const LineSegment> segments, const std::vector<Vector3>& positions) {
  std::vector<Box> boxes(segments.size());
  for (std::size_t k = 0; k < segments.size(); ++k) {
    boxes[k].extend(positions[static_cast<std::size_t>(segments[k].first)]);
    boxes[k].extend(positions[static_cast<std::size_t>(segments[k].second)]);
  }
  return boxes;
}

}  // namespace

InputSurface::InputSurface(std::span<const Triangle> triangles, std::span<const LineSegment> segments,
                           const std::vector<Vector3>& positions)
    : triangles_(triangles),
      segments_(segments),
      positions_(positions),
      normals_(positions.size(), Vector3::Zero()),
      team_(1),
      triangle_tree_(boxes_of(triangles, positions), team_),
      segment_tree_(boxes_of(segments, positions), team_) {
  for (const Triangle& triangle : triangles) {
    areas_.push_back(twice_vector_area(std::span<const Index>(triangle.nodes), positions));
    for (const Index node : triangle.nodes) normals_[static_cast<std::size_t>(node)] += areas_.back();
  }
  for (Vector3& normal : normals_) normal.stableNormalize();
}

SurfacePlace InputSurface::place_of_triangle(const Vector3& point, Index triangle) const {
  const auto& nodes = triangles_[static_cast<std::size_t>(triangle)].nodes;
  std::array<Vector3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = positions_[static_cast<std::size_t>(nodes[k])];
  SurfacePlace found{.item = triangle,
                     .face = triangles_[static_cast<std::size_t>(triangle)].face,
                     .nodes = nodes,
                     .shares = nearest_shares(point, corners)};
  for (std::size_t k = 0; k < 3; ++k) found.place += found.shares[k] * corners[k];
  return found;
}

SurfacePlace InputSurface::place_of_segment(const Vector3& point, Index segment) const {
  const auto& [first, second, face, line] = segments_[static_cast<std::size_t>(segment)];
  const Vector3& a = positions_[static_cast<std::size_t>(first)];
  const Vector3& b = positions_[static_cast<std::size_t>(second)];
  const double share = nearest_share(point, a, b);
  return {.place = (1 - share) * a + share * b,
          .item = segment,
          .face = face,
          .nodes = {first, second, second},
          .shares = {1 - share, share, 0}};
}

SurfacePlace InputSurface::nearest(const Vector3& point, const Vector3& normal, Index near) const {
  const auto square = [&](Index triangle) { return (place_of_triangle(point, triangle).place - point).squaredNorm(); };
  const auto square_of_side = [&](Index triangle) {
    return areas_[static_cast<std::size_t>(triangle)].dot(normal) < 0 ? std::numeric_limits<double>::infinity()
                                                                      : square(triangle);
  };
  const double known = near < 0 ? std::numeric_limits<double>::infinity() : square_of_side(near);
  BoxTree::Nearest found = triangle_tree_.nearest(point, square_of_side, known);
  if (found.item < 0 && known < std::numeric_limits<double>::infinity()) found.item = near;
  if (found.item < 0) found = triangle_tree_.nearest(point, square);
  return place_of_triangle(point, found.item);
}

SurfacePlace InputSurface::nearest_on_line(const Vector3& point, Index line) const {
  const auto square = [&](Index segment) {
    if (segments_[static_cast<std::size_t>(segment)].line != line) return std::numeric_limits<double>::infinity();
    return (place_of_segment(point, segment).place - point).squaredNorm();
  };
  return place_of_segment(point, segment_tree_.nearest(point, square).item);
}

Vector3 InputSurface::normal_at(const SurfacePlace& place) const {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += place.shares[k] * normal_at(place.nodes[k]);
  return sum.stableNormalized();
}

}  // namespace vspring
