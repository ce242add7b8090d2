#pragma once

#include <vector>

#include "vspring/constraints.hpp"

namespace vspring {

/// A run of successive edges of a chain that is measured.
struct CurveRun {
  std::vector<Index> nodes;  ///< no two in succession at the same place
  bool closed = false;       ///< the last is followed by the first
  Index zero_length_edges = 0;
};

/// The runs of edges with finite coordinates; with constraints only of those with a moving node, as the rest says
/// nothing about what was done.
std::vector<CurveRun> curve_runs(const PolygonCurve& curve, const Constraints* constraints);

/// The same nodes, with those chains that go through them without an edge that has no length, or an end that is not
/// finite; such nodes lie at the origin.
PolygonCurve visible_part(const PolygonCurve& curve);

}  // namespace vspring
