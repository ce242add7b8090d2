#pragma once

#include <array>
#include <span>

#include "vspring/constraints.hpp"

namespace vspring {

/// A curve whose chains end at corners and begin again there, and what holds it: corners stay where they are.
struct Sides {
  PolygonCurve curve;
  Constraints held;
  Index corners = 0;
};

/// At those of the constraints and at others, of which those with a tangent or normal given are none. Throws
/// Error(invalid_argument) for one that does not exist. Cost: linear.
Sides cut_into_sides(const PolygonCurve& curve, const Constraints& constraints, std::span<const Index> others = {});

/// Throws Error(unusable_constraint) for a corner of the constraints that is not inside of one chain and no other, or
/// has a normal given; Error(invalid_argument) for constraints of another node count. Cost: linear, if there are any.
void check_corners(const PolygonCurve& curve, const Constraints& constraints);

/// The tangents of a node before and after it; zero where none is given.
std::array<Vector3, 2> given_tangents(const Constraints& constraints, Index node);

/// How many tangents a node is given: one for both sides, or those of the sides of a corner.
Index tangents_given(const Constraints& constraints, Index node);

}  // namespace vspring
