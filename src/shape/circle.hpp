#pragma once

#include "vspring/types.hpp"

namespace vspring {

/// The curvature vector, at the second point, of the circle through three points; zero if there is none. For
/// coordinates of size near one.
inline Vector3 circle_curvature(const Vector3& before, const Vector3& here, const Vector3& after) {
  const Vector3 back = before - here;
  const Vector3 forth = after - here;
  if (back.squaredNorm() == 0 || forth.squaredNorm() == 0) return Vector3::Zero();
  // Inversion makes the circle a line, half its curvature away.
  const Vector3 p = back / back.squaredNorm();
  const Vector3 along = forth / forth.squaredNorm() - p;
  if (along.squaredNorm() == 0) return Vector3::Zero();
  const Vector3 curvature = 2 * (p - along * (p.dot(along) / along.squaredNorm()));
  return curvature.allFinite() ? curvature : Vector3::Zero();
}

}  // namespace vspring
