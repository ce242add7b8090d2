#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "shape/fan.hpp"

namespace vspring {

/// Whether the faces around a node leave a gap; the walk then begins there.
inline bool on_boundary(std::span<const Link> links) { return !links.empty() && links.front().start(); }

/// The links of many nodes, one after the other (CSR).
class Rings {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return begin_.size() - 1; }
  [[nodiscard]] std::span<const Link> links(std::size_t node) const noexcept {
    return {links_.data() + begin_[node], begin_[node + 1] - begin_[node]};
  }
  [[nodiscard]] std::span<Link> mutable_links(std::size_t node) noexcept {
    return {links_.data() + begin_[node], begin_[node + 1] - begin_[node]};
  }
  /// The place of the node's first link among all links.
  [[nodiscard]] std::size_t begin(std::size_t node) const noexcept { return begin_[node]; }
  [[nodiscard]] std::size_t link_count() const noexcept { return links_.size(); }

  void reserve(std::size_t nodes, std::size_t links) {
    begin_.reserve(nodes + 1);
    links_.reserve(links);
  }
  void add(std::span<const Link> links) {
    links_.insert(links_.end(), links.begin(), links.end());
    begin_.push_back(static_cast<std::uint32_t>(links_.size()));
  }

  /// Calls use(i, k, j, back) for edges between nodes i and j of 0 … count − 1, with the places of the two spokes among
  /// all links. Each edge comes once, with the node of begin … end − 1 that has the longer walk, so the search is short
  /// also next to nodes with very many neighbours.
  template <typename Use>
  void for_spoke_pairs(std::size_t begin, std::size_t end, std::size_t count, const Use& use) const {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t size = links(i).size();
      for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) {
        const std::size_t j = links_[k].node();
        if (!links_[k].spoke() || j >= count) continue;
        const auto there = links(j);
        if (there.size() > size || (there.size() == size && j > i)) continue;
        const auto back =
            std::find_if(there.begin(), there.end(), [&](Link link) { return link.spoke() && link.node() == i; });
        if (back != there.end()) use(i, k, j, begin_[j] + static_cast<std::size_t>(back - there.begin()));
      }
    }
  }

  /// Reverses the walk around a node, which must be of one chain.
  void turn_over(std::size_t node) {
    const auto links = mutable_links(node);
    if (links.empty()) return;
    if (links.front().start()) {
      std::reverse(links.begin(), links.end());
      links.back().code &= ~Link::start_bit;
      links.front().code |= Link::start_bit;
    } else {
      std::reverse(links.begin() + 1, links.end());
    }
  }

 private:
  std::vector<std::uint32_t> begin_ = {0};
  std::vector<Link> links_;
};

}  // namespace vspring
