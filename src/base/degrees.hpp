#pragma once

#include <numbers>

namespace vspring {

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

}  // namespace vspring
