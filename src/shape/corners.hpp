#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vspring/corners.hpp"

namespace vspring {

/// 1 for each of these nodes, one entry per node. Throws Error(invalid_argument) for one that does not exist.
std::vector<std::uint8_t> marked_corners(std::span<const Index> corners, Index node_count);

/// The same nodes, with chains that end at corners and begin again there. corners: 1 for each of them, one entry per
/// node. Cost: linear.
PolygonCurve cut_at_corners(const PolygonCurve& curve, std::span<const std::uint8_t> corners);

}  // namespace vspring
