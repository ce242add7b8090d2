#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "vspring/fit.hpp"

namespace vspring {

/// Puts into the report how far the points are that are kept and do not count, and warns where some are beyond a
/// tolerance. kept, counting: per point. held: beside what they do not count, in words.
void tell_points_at_held(std::span<const std::uint8_t> kept, std::span<const std::uint8_t> counting,
                         std::optional<double> tolerance, FitResult& found, std::string_view held = "what is held");

/// Where a surface was bent less instead.
void warn_of_least_bending(FairReport& report);

// What the distances of points, once they are measured, say against a shape that has converged.

/// noise: that was taken off. A shape that is further from its nodes than that explains is not what was asked for.
void warn_if_far_off(FitReport& report, double noise);

/// points: that pulled without a tolerance.
void warn_if_left_behind(FitReport& report, std::span<const Vector3> points);

}  // namespace vspring
