#pragma once

// Shared by tests of curves and surfaces.

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "vspring/types.hpp"

namespace vspring::support {

constexpr double degree = std::numbers::pi / 180;

inline double greatest_distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
  return greatest;
}

/// The diagonal of the box around all positions.
inline double diagonal(const std::vector<Vector3>& positions) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : positions) box.extend(position);
  return box.diagonal().norm();
}

}  // namespace vspring::support
