#pragma once

#include <span>
#include <vector>

#include "curve_fit/curve_program.hpp"

namespace vspring {

/// The way that scattered points say a curve goes: through them, in the order of their places on it, and through its
/// held nodes. Where neither is within `gap` there are nodes of the curve, moved as far as those before and after are
/// away from it. By chains, each in its order. Cost: n log n.
std::vector<CurvePoint> way_of_scattered(const DenseCurve& curve, std::span<const CurvePoint> points, double gap);

}  // namespace vspring
