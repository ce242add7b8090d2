#pragma once

#include <span>
#include <vector>

#include "shape/node_graph.hpp"

namespace vspring {

/// Orders `nodes` so that neighbours come close together: breadth first from a node at the rim of each component
/// (Cuthill and McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969). Depends on connectivity alone, so
/// that moved, turned and scaled copies of a mesh are ordered alike. Cost: linear.
std::vector<Index> order_for_locality(const NodeGraph& graph, std::span<const Index> nodes);

}  // namespace vspring
