#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "levels/triangulation.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Nodes that a coarser level lacks, in the order in which they were removed, with the neighbours that they had then
/// (their parents). In the reverse order, every node comes after its parents.
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
  /// Gives back the room for more.
  void close() {
    nodes.shrink_to_fit();
    begin.shrink_to_fit();
    parents.shrink_to_fit();
  }
};

/// Removes from a triangulation all nodes but those kept, each drawn into a neighbour, so far as it stays a surface;
/// marks those that have to stay as kept. Afterwards edges are turned where that brings the numbers of neighbours
/// nearer to six inside and four at the boundary. Returns the removals in groups: the last came after all others, which
/// do not look at each other's nodes. places: as for choose_coarse_nodes(). Cost: linear.
std::vector<Removals> coarsen(Triangulation& triangulation, std::vector<std::uint8_t>& kept, ThreadTeam& team,
                              std::span<const Vector3> places = {});

}  // namespace vspring
