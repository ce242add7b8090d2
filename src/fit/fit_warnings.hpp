#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "vspring/fit.hpp"

namespace vspring {

/// Puts into the report how far away the points are that are kept but do not count, and warns where some are beyond a
/// tolerance. kept, counting: per point. held: in words, what these points are nearest to.
void tell_points_at_held(std::span<const std::uint8_t> kept, std::span<const std::uint8_t> counting,
                         std::optional<double> tolerance, FitResult& found, std::string_view held = "what is held");

/// Where a surface was bent less instead.
void warn_of_least_bending(FairReport& report);

// Warnings by the distances of points, for a shape that has converged.

/// noise: that was taken off. Warns of a shape that is further from the given nodes than this noise explains.
void warn_if_far_off(FitReport& report, double noise);

/// points: that pulled without a tolerance.
void warn_if_left_behind(FitReport& report, std::span<const Vector3> points);

}  // namespace vspring
