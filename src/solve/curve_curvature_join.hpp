#pragma once

#include <vector>

#include "base/progress.hpp"
#include "checks/result_check.hpp"
#include "spring/net.hpp"
#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// Takes a curve that fair() has made with tangents on to Continuity::curvature. Where that is not possible, or it
/// would be worse than the input, it stays, and a warning says why. check, input: of the net before fair(), and its
/// places. net: at its equilibrium. Cost: linear.
void join_with_curvature(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                         const ResultCheck& check, const std::vector<Vector3>& input, Context& context,
                         ProgressReporter& progress, Net& net, FairReport& report);

}  // namespace vspring
