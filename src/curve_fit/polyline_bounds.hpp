#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "curve_fit/curve_program.hpp"
#include "shape/segment.hpp"

namespace vspring {

/// A place of a curve between two points, and how far from the straight line between them it may be.
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

/// For nodes, and the middles of edges that turn much, where points are more than half of `reach` apart: they may be
/// that far from the polyline of the points, and by as much more as an arc rises over an edge that turns the same way
/// at both ends. points: with their places, those of each chain in its order. Cost: linear.
std::vector<PolylineBound> polyline_bounds(const DenseCurve& curve, std::span<const CurvePoint> points, double reach);

}  // namespace vspring
