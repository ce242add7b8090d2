#pragma once

#include <cstdint>
#include <vector>

#include "levels/triangulation.hpp"

namespace vspring {

/// Which nodes the next coarser level keeps: 1, else 0. By connectivity alone: no two neighbours, and a neighbour of
/// every other node, about one in four, in rows twice as far apart where the triangulation is regular. Nodes of
/// boundary loops are every second one, but six of a loop if it has them. All nodes at spots that are not manifold are
/// kept, and of those with `constrained` as many as may be. Cost: linear.
std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained);

}  // namespace vspring
