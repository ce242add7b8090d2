#pragma once

#include <vector>

#include "shape/box_tree.hpp"
#include "shape/triangles.hpp"

namespace vspring {

/// The triangles of a mesh, each at one of the nodes at which very many meet, or at none.
struct Hubs {
  struct Hub {
    Index node = -1;
    std::vector<Index> triangles;  ///< ascending
  };
  std::vector<Hub> hubs;      ///< by the number of their node, ascending
  std::vector<Index> others;  ///< triangles at none, ascending
};

/// A triangle at several goes to that at which most meet. Cost: linear.
[[nodiscard]] Hubs find_hubs(const std::vector<Triangle>& triangles, std::size_t node_count);

/// Around where the rays from `hub` through the line from a to b meet the unit sphere around it, with room for
/// rounding. Two triangles that share the hub alone and cross do so along a line from it, so there these places meet:
/// where their boxes are apart, they do not cross.
[[nodiscard]] Box box_seen_from(const Vector3& hub, const Vector3& a, const Vector3& b);

}  // namespace vspring
