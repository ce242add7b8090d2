#pragma once

#include <vector>

#include "vspring/constraints.hpp"

namespace vspring {

/// A run of successive edges of a chain to measure.
struct CurveRun {
  std::vector<Index> nodes;  ///< no two in succession at the same place
  bool closed = false;       ///< the last is followed by the first
  Index zero_length_edges = 0;
};

/// The runs of edges with finite coordinates; with constraints only edges with a moving node, as the rest did not
/// change.
std::vector<CurveRun> curve_runs(const PolygonCurve& curve, const Constraints* constraints);

/// The curve without edges that have no length or an end that is not finite; nodes keep their numbers, and those that
/// are not finite lie at the origin.
PolygonCurve visible_part(const PolygonCurve& curve);

}  // namespace vspring
