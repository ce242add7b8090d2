#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "levels/triangulation.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A neighbour this many times as far away as the nearest one cannot represent a node on a coarser level.
constexpr double far_neighbour = 2.2;

/// Marks the nodes that the next coarser level keeps with 1. It keeps about one in four, found by a front that goes
/// over the surface: no two neighbours, but a neighbour of every other node. Of boundary loops it keeps every second
/// node, and at least six if there are so many; of `constrained` nodes as many as possible; and all nodes at
/// non-manifold spots. places: of the nodes, without noise; neighbours along the long side of long cells then do not
/// count, so cells become even from level to level. Empty: by connectivity alone. Cost: linear.
std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained,
                                              std::span<const Vector3> places = {});

/// Nodes that a coarser level lacks, in the order of their removal, with the neighbours that they had then (their
/// parents). In reverse order every node comes after its parents.
struct Removals {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> begin = {0};  ///< of each node's parents; one more entry than nodes
  std::vector<std::uint32_t> parents;

  [[nodiscard]] std::size_t size() const noexcept { return nodes.size(); }
  [[nodiscard]] std::span<const std::uint32_t> parents_of(std::size_t k) const {
    return {parents.data() + begin[k], begin[k + 1] - begin[k]};
  }
  void add(std::uint32_t node, std::span<const std::uint32_t> neighbours) {
    nodes.push_back(node);
    parents.insert(parents.end(), neighbours.begin(), neighbours.end());
    begin.push_back(static_cast<std::uint32_t>(parents.size()));
  }
  /// Frees unused memory.
  void close() {
    nodes.shrink_to_fit();
    begin.shrink_to_fit();
    parents.shrink_to_fit();
  }
};

/// Removes all nodes but the kept ones from a triangulation: each collapses into a neighbour, as long as the result is
/// a surface; nodes that must stay are marked as kept. Afterwards edges are flipped where that brings the numbers of
/// neighbours nearer to six inside and four at the boundary. Returns the removals in groups: the last group came after
/// all others, which are independent of each other. places: as for choose_coarse_nodes(). Cost: linear.
std::vector<Removals> coarsen(Triangulation& triangulation, std::vector<std::uint8_t>& kept, ThreadTeam& team,
                              std::span<const Vector3> places = {});

}  // namespace vspring
