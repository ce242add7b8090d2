#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "base/degrees.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A sum of cross products below this share of the size of its terms is rounding, not a direction.
inline constexpr double no_direction = 1e-10;

/// A cosine below this is that of an angle beyond 90°, not of rounding.
inline constexpr double beyond_right = -1e-6;

/// Whether one turns from the other by more than a right angle.
inline bool turns_back(const Vector3& a, const Vector3& b) {
  const double product = a.dot(b);
  // Hardly ever: without a root for all others.
  return product < 0 && product < beyond_right * std::sqrt(a.squaredNorm() * b.squaredNorm());
}

/// The angle between two directions of any length, in degrees.
inline double degrees_between(const Vector3& a, const Vector3& b) {
  return degrees_per_radian * std::atan2(a.cross(b).norm(), a.dot(b));
}

/// `sum` as a unit vector, or zero if it is rounding only. scale: the total size of its terms.
inline Vector3 direction(const Vector3& sum, double scale) {
  const double length = std::sqrt(sum.dot(sum));
  if (!(length > no_direction * scale)) return Vector3::Zero();
  return sum / length;
}

}  // namespace vspring
