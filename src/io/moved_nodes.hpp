#pragma once

#include <cstdint>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Marks the nodes whose position is not the one in `before`, to the bit. Throws Error(invalid_argument) for one that
/// moved to nowhere.
std::vector<std::uint8_t> moved_nodes(const std::vector<Vector3>& before, const std::vector<Vector3>& positions);

}  // namespace vspring
