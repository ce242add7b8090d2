#pragma once

#include "vspring/types.hpp"

namespace vspring {

/// How far around the nearest node to search for one that faces alike, in mean edges.
inline constexpr double reach_in_edges = 10;

/// Whether a point may be tied to a node, by the normals of both: within 90° of each other, or one of them unknown
/// (zero). margin: by what their cosine must be more than 0.
inline bool face_alike(const Vector3& of_point, const Vector3& of_node, double margin = 0) {
  return of_point.isZero(0) || of_node.isZero(0) || of_point.dot(of_node) >= margin;
}

}  // namespace vspring
