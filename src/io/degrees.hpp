#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/local_plane.hpp"

namespace vspring {

/// Throws Error(unusable_file) naming the line if its latitude or longitude (−180 … 360) is out of range.
void require_place(const InputFile& file, std::size_t offset, const LocalPlane::Place& place);

/// Maps positions in degrees (x: longitude, y: latitude) to metres in a plane: the given one, or one about the middle
/// of the box around them. There must be at least one. Cost: linear.
LocalPlane take_to_plane(std::vector<Vector3>& positions, const std::optional<LocalPlane>& plane);

/// Says how far positions reach if lengths in the plane are wrong by more than a thousandth; else empty.
std::string stretch_warning(const InputFile& file, const LocalPlane& plane, const std::vector<Vector3>& positions);

/// "47.123456, 8.5": the origin, for messages.
std::string origin_of(const LocalPlane& plane);

/// Appends degrees as GPX has them, without an exponent, to 1e-12: a tenth of a micrometre on the ground. Coarser
/// rounding would make waves in the curvature of close points.
void append_degrees(std::string& text, double degrees);

}  // namespace vspring
