#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "spring/net.hpp"

namespace vspring {

/// As many as a quadratic with a tangent plane has unknowns.
constexpr std::size_t enough_near_nodes = 5;

/// Links of a node beyond which those of its neighbours are not near to each other.
constexpr std::size_t most_links_beside = 64;

/// Calls use(node) for the nodes that a quadratic around a node is fitted to: those of its link; if these are fewer
/// than its unknowns, also those of their links, unless they are very many.
template <typename Use>
void for_near_nodes(const Net& net, std::size_t i, const Use& use) {
  const auto links = net.rings.links(i);
  if (links.size() >= enough_near_nodes) {
    for (const Link link : links) use(link.node());
    return;
  }
  std::vector<std::size_t> nodes;
  for (const Link link : links) {
    nodes.push_back(link.node());
    if (link.node() >= net.computed || net.rings.links(link.node()).size() > most_links_beside) continue;
    for (const Link next : net.rings.links(link.node())) nodes.push_back(next.node());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::erase(nodes, i);
  for (const std::size_t j : nodes) use(j);
}

}  // namespace vspring
