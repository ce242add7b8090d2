#pragma once

#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"

namespace VSPRING_API vspring {

/// Finds the corners of a curve: nodes inside open chains, or anywhere on closed ones, at which successive edges turn
/// by more than `angle`. angle: degrees, more than 0 and less than 180. Returns node numbers in the order of the
/// chains; of several nodes at one place, the first. Coordinates that are not finite make no corners. Throws
/// Error(invalid_argument) for an angle out of range. Cost: linear.
[[nodiscard]] std::vector<Index> find_corners(const PolygonCurve& curve, double angle);

}  // namespace vspring
