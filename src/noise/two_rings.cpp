#include "noise/two_rings.hpp"

#include <algorithm>
#include <cstddef>

namespace vspring {

namespace {

// Nodes with more faces are hubs.
constexpr std::size_t most_faces_of_node = 100;
constexpr std::size_t most_neighbours = 2 * most_faces_of_node;

}  // namespace

void two_rings(const NodeGraph& graph, const Incidence& incidence, Index node, std::vector<Index>& around) {
  around.assign(1, node);
  graph.for_each_neighbour(node, [&](Index j) { around.push_back(j); });
  const std::size_t neighbours = around.size();
  if (neighbours > most_neighbours) {
    around.clear();
    return;
  }
  for (std::size_t k = 1; k < neighbours; ++k) {
    if (incidence.corners(around[k]).size() > most_faces_of_node) continue;
    graph.for_each_neighbour(around[k], [&](Index j) { around.push_back(j); });
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
}

}  // namespace vspring
