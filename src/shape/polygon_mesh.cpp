#include "vspring/polygon_mesh.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "vspring/error.hpp"

namespace vspring {

PolygonMesh::PolygonMesh() : PolygonMesh({}, {0}, {}) {}

PolygonMesh::PolygonMesh(std::vector<Vector3> positions, std::vector<Index> face_begin, std::vector<Index> corners)
    : positions_(std::make_shared<const std::vector<Vector3>>(std::move(positions))),
      faces_(std::make_shared<const Faces>(Faces{std::move(face_begin), std::move(corners)})) {
  const std::vector<Index>& begin = faces_->begin;
  const std::size_t count = faces_->corners.size();
  if (begin.empty() || begin.front() != 0 || begin.back() != static_cast<Index>(count))
    throw Error(ErrorCode::unusable_shape,
                fmt::format("face offsets must begin with 0 and end with the number of corners, {}", count));
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    if (begin[f] > begin[f + 1])
      throw Error(ErrorCode::unusable_shape, fmt::format("face {}: its offset lies behind that of the next face", f));
  }
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
  std::vector<Index> face_begin;
  for (std::size_t c = 0; c <= corners.size(); c += static_cast<std::size_t>(sides))
    face_begin.push_back(static_cast<Index>(c));
  return from_arrays(coordinates, face_begin, corners);
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

void PolygonMesh::set_positions(std::vector<Vector3> positions) {
  if (positions.size() != positions_->size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), positions_->size()));
  positions_ = std::make_shared<const std::vector<Vector3>>(std::move(positions));
}

}  // namespace vspring
