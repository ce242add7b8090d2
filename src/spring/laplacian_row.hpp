#pragma once

#include <cstddef>

#include "spring/link_edges.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Finds the row of the cotangent Laplacian of a node with a ring, and the node's share of area, see SphereSprings.
/// Cost: linear in the links.
void find_laplacian_row(Net& net, std::size_t i, const LinkEdges& edges);

}  // namespace vspring
