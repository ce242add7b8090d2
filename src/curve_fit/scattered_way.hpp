#pragma once

#include <span>
#include <vector>

#include "curve_fit/curve_program.hpp"

namespace vspring {

/// The way of a curve as scattered points show it: through the points, in the order of their places on the curve, and
/// through its held nodes. In gaps wider than `gap` it goes through nodes of the curve, displaced like the points
/// before and after. By chains, in order. Cost: n log n.
std::vector<CurvePoint> way_of_scattered(const DenseCurve& curve, std::span<const CurvePoint> points, double gap);

}  // namespace vspring
