#pragma once

#include <array>
#include <span>

#include "vspring/constraints.hpp"

namespace vspring {

/// A curve with its chains cut at corners, and its constraints; corners are fixed.
struct Sides {
  PolygonCurve curve;
  Constraints held;
  Index corners = 0;
};

/// Cuts a curve at the corners of its constraints and at other ones; the latter are ignored where a tangent or normal
/// is given. Throws Error(invalid_argument) for a corner that is no node. Cost: linear.
Sides cut_into_sides(const PolygonCurve& curve, const Constraints& constraints, std::span<const Index> others = {});

/// Throws Error(unusable_constraint) for a corner of the constraints that has a normal, or does not lie inside exactly
/// one chain; Error(invalid_argument) for constraints of another node count. Cost: linear, if there are any.
void check_corners(const PolygonCurve& curve, const Constraints& constraints);

/// The tangents of a node before and after it; zero where none is given.
std::array<Vector3, 2> given_tangents(const Constraints& constraints, Index node);

/// The number of tangents that a node is given: one for both sides, or one for each side of a corner.
Index tangents_given(const Constraints& constraints, Index node);

}  // namespace vspring
