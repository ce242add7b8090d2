#pragma once

#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Throws Error(unusable_shape) naming the first of these nodes that has a coordinate that is not finite.
void require_places(std::span<const Index> nodes, const std::vector<Vector3>& positions);

}  // namespace vspring
