#pragma once

#include <span>

#include "vspring/fit.hpp"

namespace vspring {

/// Where a surface was bent less instead.
/// Where points at what is held are further away than the tolerance.
void warn_of_points_at_held(FitReport& report, double tolerance);

void warn_of_least_bending(FairReport& report);

// What the distances of points, once they are measured, say against a shape that has converged.

/// noise: that was taken off. A shape that is further from its nodes than that explains is not what was asked for.
void warn_if_far_off(FitReport& report, double noise);

/// points: that pulled without a tolerance.
void warn_if_left_behind(FitReport& report, std::span<const Vector3> points);

}  // namespace vspring
