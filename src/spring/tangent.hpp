#pragma once

// Directions of curves (§4.8). The circle through three successive nodes has at the middle one the tangent T ∝ e₋/ℓ₋² +
// e₊/ℓ₊² (e: the edges before and after, ℓ: their lengths): the inversion that gives surfaces Max's weights. Exact on
// circles however uneven the spacing, where the paper's P_{i+1} − P_{i−1} is exact for equal edges only.

#include <Eigen/Geometry>
#include <span>

#include "shape/fan.hpp"
#include "spring/pseudo_normal.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Edges before and after a node of a curve, from its links: the previous node, then the next. An end has only one of
/// them, and both edges are that one: the tangent of an end is its chord.
struct CurveEdges {
  Vector3 before;
  Vector3 after;

  template <typename Positions>
  CurveEdges(const Vector3& centre, std::span<const Link> links, const Positions& positions) {
    const Vector3 first = positions[links.front().node()] - centre;
    if (links.size() > 1) {
      before = -first;
      after = positions[links[1].node()] - centre;
    } else {
      // Only the first link of a curve's first node leads forwards; it has no mark of a start.
      before = after = links.front().start() ? Vector3(-first) : first;
    }
  }
};

/// Tangent of the circle through the three nodes; zero where all three coincide.
struct CircleTangent {
  template <typename Positions>
  Vector3 operator()(const Vector3& centre, std::span<const Link> links, const Positions& positions) const {
    if (links.empty()) return Vector3::Zero();
    const CurveEdges edges(centre, links, positions);
    Vector3 sum = Vector3::Zero();
    double scale = 0;
    for (const Vector3* edge : {&edges.before, &edges.after}) {
      const double length2 = edge->dot(*edge);
      if (!(length2 > 0)) continue;
      sum += *edge / length2;
      scale += 1 / std::sqrt(length2);
    }
    return direction(sum, scale);
  }
};

/// The paper's tangent, along the chord of the two neighbours.
struct ChordTangent {
  template <typename Positions>
  Vector3 operator()(const Vector3& centre, std::span<const Link> links, const Positions& positions) const {
    if (links.empty()) return Vector3::Zero();
    const CurveEdges edges(centre, links, positions);
    return direction(edges.before + edges.after, edges.before.norm() + edges.after.norm());
  }
};

/// The paper's principal normal N ∝ B × T, B across the plane of the three nodes; zero where they lie on a line.
template <typename Positions>
Vector3 principal_normal(const Vector3& centre, std::span<const Link> links, const Positions& positions,
                         const Vector3& tangent) {
  if (links.empty()) return Vector3::Zero();
  const CurveEdges edges(centre, links, positions);
  return direction(edges.before.cross(edges.after).cross(tangent), edges.before.norm() * edges.after.norm());
}

}  // namespace vspring
