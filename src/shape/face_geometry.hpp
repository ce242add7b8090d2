#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "shape/direction.hpp"
#include "vspring/types.hpp"

namespace vspring {

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
