#pragma once

#include <cmath>

#include "vspring/types.hpp"

namespace vspring {

/// A sum of cross products below this share of the size of its terms is rounding, not a direction.
inline constexpr double no_direction = 1e-10;

/// A cosine below this is that of an angle beyond 90°, not of rounding.
inline constexpr double beyond_right = -1e-6;

/// `sum` as a unit vector, or zero if it is rounding only. scale: the total size of its terms.
inline Vector3 direction(const Vector3& sum, double scale) {
  const double length = std::sqrt(sum.dot(sum));
  if (!(length > no_direction * scale)) return Vector3::Zero();
  return sum / length;
}

}  // namespace vspring
