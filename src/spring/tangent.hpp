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

/// Edges before and after a node of a curve, from its links: the previous node, then the next. An end has one edge
/// only, which stands for both, so the tangent of an end is its chord.
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
      // Only at a curve's first node does the first link lead forwards; it has no mark of a start.
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

/// The rounding error of a product: a × b = p + product_error(a, b, p) exactly (T. J. Dekker, "A floating-point
/// technique for extending the available precision", Numer. Math. 18, 1971).
inline double product_error(double a, double b, double p) {
  constexpr double split = 134217729;  // 2^27 + 1
  const double a_high = split * a - (split * a - a);
  const double b_high = split * b - (split * b - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return a_low * b_low - (((p - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/// The curvature vector of the circle through the three nodes, across its tangent at the middle one; zero at ends,
/// whose chord is straight. Its relative error is that of rounding: as edges are nearly parallel, their cross product
/// is computed from one edge and its difference from the other. Along n nodes that reduces errors by a factor n.
template <typename Positions>
Vector3 circle_curvature(const Vector3& centre, std::span<const Link> links, const Positions& positions,
                         const Vector3& tangent) {
  if (links.size() < 2) return Vector3::Zero();
  const CurveEdges edges(centre, links, positions);
  const double before = edges.before.norm();
  const double after = edges.after.norm();
  const double chord = (edges.before + edges.after).norm();
  const double product = before * after * chord;
  if (!(product > 0)) return Vector3::Zero();
  const double ratio = after / before;
  Vector3 difference;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double scaled = ratio * edges.before[k];
    difference[k] = (edges.after[k] - scaled) - product_error(ratio, edges.before[k], scaled);
  }
  return (2 / product) * edges.before.cross(difference).cross(tangent);
}

/// The paper's principal normal N ∝ B × T, B across the plane of the three nodes; zero if they lie on a line.
template <typename Positions>
Vector3 principal_normal(const Vector3& centre, std::span<const Link> links, const Positions& positions,
                         const Vector3& tangent) {
  if (links.empty()) return Vector3::Zero();
  const CurveEdges edges(centre, links, positions);
  return direction(edges.before.cross(edges.after).cross(tangent), edges.before.norm() * edges.after.norm());
}

}  // namespace vspring
