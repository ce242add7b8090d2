#pragma once

#include <cmath>

#include "vspring/types.hpp"

namespace vspring {

/// Below this share of its terms' size a sum of cross products is rounding, not a direction.
inline constexpr double no_direction = 1e-10;

/// A cosine below this tells of an angle beyond 90° in spite of rounding.
inline constexpr double beyond_right = -1e-6;

/// Unit vector, or zero where `sum` is lost in the rounding of terms of size `scale` together.
inline Vector3 direction(const Vector3& sum, double scale) {
  const double length = std::sqrt(sum.dot(sum));
  if (!(length > no_direction * scale)) return Vector3::Zero();
  return sum / length;
}

}  // namespace vspring
