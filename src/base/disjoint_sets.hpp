#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vspring {

/// Disjoint sets of the numbers from 0 on, at first one for each (union-find with path halving). The least number
/// represents a set. Cost of a call: about constant.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  [[nodiscard]] std::size_t find(std::size_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }

  /// Joins two sets and returns the representative of the union.
  std::size_t join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
    return low;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace vspring
