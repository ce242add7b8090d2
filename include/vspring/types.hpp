#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// Number of a node or a face: 0-based, in the order of the input.
using Index = std::int32_t;

using Vector3 = Eigen::Vector3d;

/// A view of the coordinates of positions, x, y, z of each in turn.
[[nodiscard]] inline std::span<const double> coordinates(std::span<const Vector3> positions) noexcept {
  static_assert(sizeof(Vector3) == 3 * sizeof(double));
  return {positions.empty() ? nullptr : positions.front().data(), 3 * positions.size()};
}

/// Positions from coordinates, x, y, z of each in turn. Throws Error(invalid_argument) unless their number is a
/// multiple of three. Cost: one copy.
[[nodiscard]] std::vector<Vector3> positions_of(std::span<const double> coordinates);

}  // namespace vspring
