#pragma once

#include <span>
#include <utility>
#include <vector>

#include "shape/point_tree.hpp"

namespace vspring {

/// The edges of a Euclidean minimum spanning tree (O. Borůvka 1926): each round joins every group of points to the
/// nearest other one. tree: of these points, no two of which are equal. Cost: about n log² n.
std::vector<std::pair<Index, Index>> spanning_tree(std::span<const Vector3> points, PointTree& tree);

}  // namespace vspring
