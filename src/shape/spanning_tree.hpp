#pragma once

#include <span>
#include <utility>
#include <vector>

#include "shape/point_tree.hpp"

namespace vspring {

/// The edges of a tree through all points whose sum of lengths is the least there is (O. Borůvka 1926): each round
/// joins every group of points with the one nearest to it. tree: of these points, no two of them equal. Cost: some
/// n log² n.
std::vector<std::pair<Index, Index>> spanning_tree(std::span<const Vector3> points, PointTree& tree);

}  // namespace vspring
