#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vspring/constraints.hpp"

namespace vspring {

/// As the public ones, where scattered points hold a shape too. pulled: one entry per node, 1 where points are tied to
/// it; empty: none.
std::vector<std::string> check_constraints(const PolygonMesh& mesh, const Constraints& constraints,
                                           std::span<const std::uint8_t> pulled);
std::vector<std::string> check_constraints(const PolygonCurve& curve, const Constraints& constraints,
                                           std::span<const std::uint8_t> pulled);

}  // namespace vspring
