#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace vspring {

/// Number of a node or a face: 0-based, in the order of the input.
using Index = std::int32_t;

using Vector3 = Eigen::Vector3d;

}  // namespace vspring
