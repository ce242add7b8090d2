#pragma once

#include <algorithm>
#include <cmath>

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

/// The cubic from `start` to start + chord with unit tangents at its ends, at v from 0 to 1. On a circle its error is
/// of sixth order in the chord.
inline Vector3 on_cubic(const Vector3& start, const Vector3& chord, const Vector3& tangent_start,
                        const Vector3& tangent_end, double v) {
  const double cosine = std::clamp(tangent_start.dot(tangent_end), -1.0, 1.0);
  // The cubic nearest to a circular arc that turns by an angle θ starts with the speed chord / cos²(θ/4).
  const double speed = 2 * chord.norm() / (1 + std::sqrt((1 + cosine) / 2));
  const double w = 1 - v;
  return start + v * v * (3 - 2 * v) * chord + v * w * w * speed * tangent_start - v * v * w * speed * tangent_end;
}

}  // namespace vspring
