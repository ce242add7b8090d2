#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "levels/triangulation.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A neighbour this many times as far away as the nearest one cannot represent a node on a coarser level.
constexpr double far_neighbour = 2.2;

/// Marks the nodes that the next coarser level keeps with 1. It keeps about one in four, found by a front that goes
/// over the surface: no two neighbours, but a neighbour of every other node. Of boundary loops it keeps every second
/// node, and at least six if there are so many; of `constrained` nodes as many as possible; and all nodes at
/// non-manifold spots. places: of the nodes, without noise; neighbours along the long side of long cells then do not
/// count, so cells become even from level to level. Empty: by connectivity alone. Cost: linear.
std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained,
                                              std::span<const Vector3> places = {});

}  // namespace vspring
