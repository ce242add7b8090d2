#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vspring {

/// Sets of the numbers from 0 on, each of them alone at first (union-find with path halving). The representative of a
/// set is its least number. Cost of a call: about constant.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  [[nodiscard]] std::size_t find(std::size_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }

  /// Returns the representative of the two as one.
  std::size_t join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
    return low;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace vspring
