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

struct BoundedPlaces {
  bool everywhere = false;  ///< also where points are not more than half of the reach apart
  int parts = 0;            ///< of all edges, at the beginning of each; 0: nodes, and middles of edges that turn much
};

/// Places may be as far from the polyline of the points as `reach`, and by as much more as an arc rises over an edge of
/// it that turns the same way at both ends. points: with their places, those of each chain in its order. Cost: linear.
std::vector<PolylineBound> polyline_bounds(const DenseCurve& curve, std::span<const CurvePoint> points, double reach,
                                           BoundedPlaces places = {});

}  // namespace vspring
