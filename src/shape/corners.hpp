#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vspring/corners.hpp"

namespace vspring {

/// One entry per node, 1 for corners. Throws Error(invalid_argument) for a corner that is no node.
std::vector<std::uint8_t> marked_corners(std::span<const Index> corners, Index node_count);

/// The curve with its chains cut at corners. corners: 1 for each of them, one entry per node. Cost: linear.
PolygonCurve cut_at_corners(const PolygonCurve& curve, std::span<const std::uint8_t> corners);

}  // namespace vspring
