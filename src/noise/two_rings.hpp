#pragma once

#include <vector>

#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"

namespace vspring {

/// Sets `around` to the node, its neighbours and theirs, in ascending order; to nothing at a hub, of which too many
/// nodes are neighbours. Neighbours of neighbours that are hubs are left out. Cost: linear in them.
void two_rings(const NodeGraph& graph, const Incidence& incidence, Index node, std::vector<Index>& around);

}  // namespace vspring
