#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>

#include "shape/segment.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// The shares of the corners in the place of a triangle nearest to a point.
inline std::array<double, 3> nearest_shares(const Vector3& point, const std::array<Vector3, 3>& corners) {
  const Vector3 area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  std::array<double, 3> parts = {0, 0, 0};
  bool is_inside = area.squaredNorm() > 0;
  for (std::size_t k = 0; k < 3 && is_inside; ++k) {
    const Vector3& next = corners[(k + 1) % 3];
    parts[k] = (corners[(k + 2) % 3] - next).cross(point - next).dot(area);
    is_inside = parts[k] >= 0;
  }
  if (is_inside) {
    const double sum = parts[0] + parts[1] + parts[2];
    return {parts[0] / sum, parts[1] / sum, parts[2] / sum};
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& first = corners[k];
    const Vector3& second = corners[(k + 1) % 3];
    const double share = nearest_share(point, first, second);
    const double square = (point - first - share * (second - first)).squaredNorm();
    if (!(square < least)) continue;
    least = square;
    parts = {0, 0, 0};
    parts[k] = 1 - share;
    parts[(k + 1) % 3] = share;
  }
  return parts;
}

}  // namespace vspring
