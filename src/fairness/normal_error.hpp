#pragma once

#include <optional>

#include "vspring/constraints.hpp"

namespace vspring {

/// Largest angle between a given normal and the surface's own, degrees, over the nodes with a face that has a moving
/// node; none where there are no such nodes.
std::optional<double> normal_error(const PolygonMesh& mesh, const Constraints& constraints);

/// Largest angle between a given tangent, or the plane across a given normal, and the curve's own tangent on each side
/// that moves, degrees; none where there are no such nodes.
std::optional<double> normal_error(const PolygonCurve& curve, const Constraints& constraints);

}  // namespace vspring
