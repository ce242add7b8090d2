#pragma once

#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"

namespace VSPRING_API vspring {

/// The corners of a curve: nodes inside its chains, or anywhere on closed ones, at which successive edges turn by more
/// than an angle, in degrees, more than 0 and less than 180. Of several at one place, the first. In the order of the
/// chains. Coordinates that are not finite make no corners. Throws Error(invalid_argument) for another angle. Cost:
/// linear.
[[nodiscard]] std::vector<Index> find_corners(const PolygonCurve& curve, double angle);

}  // namespace vspring
