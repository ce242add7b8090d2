#include "vspring/polygon_mesh.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "vspring/error.hpp"

namespace vspring {

namespace {

/// The number of nodes of each face; 0 if faces differ, or there are none.
Index common_sides(const std::vector<Index>& begin) {
  if (begin.size() < 2) return 0;
  const Index sides = begin[1] - begin[0];
  for (std::size_t f = 1; f + 1 < begin.size(); ++f) {
    if (begin[f + 1] - begin[f] != sides) return 0;
  }
  return sides;
}

}  // namespace

PolygonMesh::PolygonMesh() : PolygonMesh({}, {0}, {}) {}

PolygonMesh::PolygonMesh(std::vector<Vector3> positions, std::vector<Index> face_begin, std::vector<Index> corners)
    : PolygonMesh(std::move(positions), faces_of(std::move(face_begin), std::move(corners))) {}

PolygonMesh::Faces PolygonMesh::faces_of(std::vector<Index> face_begin, std::vector<Index> corners) {
  if (face_begin.empty() || face_begin.front() != 0 || !std::cmp_equal(face_begin.back(), corners.size()))
    throw Error(ErrorCode::unusable_shape,
                fmt::format("face offsets must begin with 0 and end with the number of corners, {}", corners.size()));
  for (std::size_t f = 0; f + 1 < face_begin.size(); ++f) {
    if (face_begin[f] > face_begin[f + 1])
      throw Error(ErrorCode::unusable_shape, fmt::format("face {}: its offset lies behind that of the next face", f));
  }
  const auto count = static_cast<Index>(face_begin.size() - 1);
  // Meshes of triangles need no offsets: saves memory in large ones.
  const Index sides = common_sides(face_begin);
  if (sides > 0) face_begin = std::vector<Index>();
  return {count, sides, std::move(face_begin), std::move(corners)};
}

PolygonMesh::PolygonMesh(std::vector<Vector3> positions, Faces faces)
    : positions_(std::make_shared<const std::vector<Vector3>>(std::move(positions))),
      faces_(std::make_shared<const Faces>(std::move(faces))) {
  for (Index f = 0; f < face_count(); ++f) {
    for (const Index node : face(f)) {
      if (node < 0 || node >= node_count())
        throw Error(ErrorCode::unusable_shape,
                    node_count() == 0 ? fmt::format("face {}: node {} does not exist, there are none", f, node)
                                      : fmt::format("face {}: node {} does not exist, nodes go from 0 to {}", f, node,
                                                    node_count() - 1));
    }
  }
}

PolygonMesh PolygonMesh::from_arrays(std::span<const double> coordinates, std::span<const Index> face_begin,
                                     std::span<const Index> corners) {
  return {positions_of(coordinates), std::vector<Index>(face_begin.begin(), face_begin.end()),
          std::vector<Index>(corners.begin(), corners.end())};
}

PolygonMesh PolygonMesh::from_arrays(std::span<const double> coordinates, std::span<const Index> corners, Index sides) {
  if (sides < 1) throw Error(ErrorCode::invalid_argument, fmt::format("faces must have 1 node or more, not {}", sides));
  if (corners.size() % static_cast<std::size_t>(sides) != 0)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} corners are no whole number of faces with {} nodes", corners.size(), sides));
  if (!std::in_range<Index>(corners.size()))
    throw Error(ErrorCode::invalid_argument, fmt::format("{} corners are more than {}, the most that a mesh can have",
                                                         corners.size(), std::numeric_limits<Index>::max()));
  return {
      positions_of(coordinates),
      Faces{static_cast<Index>(corners.size()) / sides, sides, {}, std::vector<Index>(corners.begin(), corners.end())}};
}

std::vector<Vector3> positions_of(std::span<const double> coordinates) {
  if (coordinates.size() % 3 != 0)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} coordinates are no whole number of positions of three", coordinates.size()));
  std::vector<Vector3> positions(coordinates.size() / 3);
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] = Vector3(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
  return positions;
}

std::vector<Index> PolygonMesh::face_begin() const {
  if (!faces_->begin.empty()) return faces_->begin;
  std::vector<Index> begin(static_cast<std::size_t>(faces_->count) + 1);
  for (Index f = 0; f <= faces_->count; ++f) begin[static_cast<std::size_t>(f)] = face_begin(f);
  return begin;
}

bool PolygonMesh::has_same_faces(const PolygonMesh& other) const {
  const Faces& a = *faces_;
  const Faces& b = *other.faces_;
  return node_count() == other.node_count() &&
         (faces_ == other.faces_ ||
          (a.count == b.count && a.sides == b.sides && a.begin == b.begin && a.corners == b.corners));
}

void PolygonMesh::set_positions(std::vector<Vector3> positions) {
  if (positions.size() != positions_->size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), positions_->size()));
  positions_ = std::make_shared<const std::vector<Vector3>>(std::move(positions));
}

void PolygonMesh::set_positions(std::span<const double> coordinates) { set_positions(positions_of(coordinates)); }

}  // namespace vspring
