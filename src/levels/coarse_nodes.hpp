#pragma once

#include <cstdint>
#include <vector>

#include "levels/triangulation.hpp"

namespace vspring {

/// Which nodes the next coarser level keeps: 1, else 0. By connectivity alone: no two neighbours, and a neighbour of
/// every other node, about one in four, found by a front that goes over the surface. Of boundary loops it is every
/// second node, but six if there are so many. All nodes at spots that are not manifold are
/// kept, and of those with `constrained` as many as may be. Cost: linear.
std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained);

}  // namespace vspring
