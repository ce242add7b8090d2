#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "levels/triangulation.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A neighbour so many times as far away as the nearest one cannot stand for a node on a coarser level.
constexpr double far_neighbour = 2.2;

/// Which nodes the next coarser level keeps: 1, else 0. No two neighbours, and a neighbour of every other node, about
/// one in four, found by a front that goes over the surface. Of boundary loops it is every second node, but six if
/// there are so many. All nodes at spots that are not manifold are kept, and of those with `constrained` as many as may
/// be. places: of the nodes, free of noise; neighbours along the long side of long cells then do not count as such, so
/// that cells become even from level to level. Empty: by connectivity alone. Cost: linear.
std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained,
                                              std::span<const Vector3> places = {});

}  // namespace vspring
