#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "curve_fit/curve_program.hpp"
#include "shape/segment.hpp"

namespace vspring {

/// A place of a curve between two points, and its greatest distance from the straight line between them.
struct PolylineBound {
  CurvePlace at = {};
  Vector3 from = Vector3::Zero();
  Vector3 to = Vector3::Zero();
  double bound = 0;

  [[nodiscard]] Vector3 nearest(const Vector3& place) const {
    return from + nearest_share(place, from, to) * (to - from);
  }
  [[nodiscard]] double distance(const Vector3& place) const { return (place - nearest(place)).norm(); }
};

struct BoundedPlaces {
  bool everywhere = false;  ///< also between points at most half of the reach apart
  int parts = 0;            ///< number of places per edge; 0: its first node and its middle
};

/// Bounds of places of a curve: they may be as far from the polyline of the points as `reach`, plus the rise of an arc
/// over an edge of it that turns the same way at both ends. points: with their places, by chains, in order. Cost:
/// linear.
std::vector<PolylineBound> polyline_bounds(const DenseCurve& curve, std::span<const CurvePoint> points, double reach,
                                           BoundedPlaces places = {});

}  // namespace vspring
