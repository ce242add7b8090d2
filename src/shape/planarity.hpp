#pragma once

#include <optional>
#include <span>

#include "vspring/types.hpp"

namespace vspring {

/// The unit normal of the plane in which all positions lie, to 1e-9 of their extent; none if they lie in no plane, or
/// on a line. Positions must be finite. The largest component of the normal is positive. Cost: linear.
[[nodiscard]] std::optional<Vector3> plane_normal(std::span<const Vector3> positions);

}  // namespace vspring
