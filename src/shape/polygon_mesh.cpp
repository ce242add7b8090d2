#include "vspring/polygon_mesh.hpp"

#include <fmt/format.h>

#include "vspring/error.hpp"

namespace vspring {

PolygonMesh::PolygonMesh(std::vector<Vector3> positions, std::vector<Index> face_begin, std::vector<Index> corners)
    : positions_(std::move(positions)), face_begin_(std::move(face_begin)), corners_(std::move(corners)) {
  if (face_begin_.empty() || face_begin_.front() != 0 || face_begin_.back() != static_cast<Index>(corners_.size()))
    throw Error(ErrorCode::unusable_shape,
                fmt::format("face offsets must begin with 0 and end with the number of corners, {}", corners_.size()));
  for (std::size_t f = 0; f + 1 < face_begin_.size(); ++f) {
    if (face_begin_[f] > face_begin_[f + 1])
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

void PolygonMesh::set_positions(std::vector<Vector3> positions) {
  if (positions.size() != positions_.size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), positions_.size()));
  positions_ = std::move(positions);
}

}  // namespace vspring
