#pragma once

#include <algorithm>

#include "vspring/types.hpp"

namespace vspring {

/// The share of the way from a to b at which the segment is nearest to a point, from 0 to 1.
inline double nearest_share(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 edge = b - a;
  const double length2 = edge.squaredNorm();
  return length2 > 0 ? std::clamp((point - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
}

}  // namespace vspring
