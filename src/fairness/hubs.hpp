#pragma once

#include <vector>

#include "shape/box_tree.hpp"
#include "shape/triangles.hpp"

namespace vspring {

/// The triangles of a mesh, grouped by hubs: nodes at which very many meet.
struct Hubs {
  struct Hub {
    Index node = -1;
    std::vector<Index> triangles;  ///< ascending
  };
  std::vector<Hub> hubs;      ///< by the number of their node, ascending
  std::vector<Index> others;  ///< triangles at no hub, ascending
};

/// A triangle at several hubs belongs to the one with the most triangles. Cost: linear.
[[nodiscard]] Hubs find_hubs(const std::vector<Triangle>& triangles, std::size_t node_count);

/// A box around the edge from a to b as projected onto the unit sphere around `hub`, with room for rounding. Two
/// triangles that share only the hub cross along a line from it, so their projections meet: if their boxes are apart,
/// they do not cross.
[[nodiscard]] Box box_seen_from(const Vector3& hub, const Vector3& a, const Vector3& b);

}  // namespace vspring
