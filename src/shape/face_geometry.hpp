#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "shape/direction.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Twice the vector area of a face, given as numbers of positions; zero for fewer than three nodes.
template <typename Node>
Vector3 twice_vector_area(std::span<const Node> face, const std::vector<Vector3>& positions) {
  const auto edge_to = [&](std::size_t k) -> Vector3 {
    return positions[static_cast<std::size_t>(face[k])] - positions[static_cast<std::size_t>(face[0])];
  };
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 2; k < face.size(); ++k) sum += edge_to(k - 1).cross(edge_to(k));
  return sum;
}

/// Unit normal of a face of three or more nodes, along its vector area; zero where it has none.
inline Vector3 unit_normal(std::span<const Index> face, const std::vector<Vector3>& positions) {
  const Vector3& first = positions[static_cast<std::size_t>(face[0])];
  Vector3 sum = Vector3::Zero();
  double scale = 0;
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    const Vector3 a = positions[static_cast<std::size_t>(face[k])] - first;
    const Vector3 b = positions[static_cast<std::size_t>(face[k + 1])] - first;
    sum += a.cross(b);
    scale += a.dot(a) + b.dot(b);
  }
  return direction(sum, scale);
}

}  // namespace vspring
