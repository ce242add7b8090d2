#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/local_plane.hpp"

namespace vspring {

/// Throws Error(unusable_file) naming the line where its latitude or longitude (−180 … 360) is none.
void require_place(const InputFile& file, std::size_t offset, const LocalPlane::Place& place);

/// Positions that were read as degrees, longitude in place of x and latitude in place of y, become metres in a plane:
/// the given one, or one about the middle of the box around them. None may be empty. Cost: linear.
LocalPlane take_to_plane(std::vector<Vector3>& positions, const std::optional<LocalPlane>& plane);

/// Says how far positions reach where lengths in the plane are wrong by more than a thousandth; else empty.
std::string stretch_warning(const InputFile& file, const LocalPlane& plane, const std::vector<Vector3>& positions);

/// "47.123456, 8.5": the origin, for messages.
std::string origin_of(const LocalPlane& plane);

/// Appends degrees as GPX has them, without an exponent: to 1e-12, a tenth of a micrometre on the ground. What is
/// coarser makes waves in the curvature of points that lie close together.
void append_degrees(std::string& text, double degrees);

}  // namespace vspring
