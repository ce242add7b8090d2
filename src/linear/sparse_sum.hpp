#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linear/sparse_rows.hpp"

namespace vspring {

/// A row while it is summed up: columns in the order in which they came.
class SparseSum {
 public:
  using Entry = SparseRows::Entry;

  void add(std::uint32_t column, double value) {
    std::size_t at = slot(column);
    while (slots_[at] != none && entries_[slots_[at]].column != column) at = (at + 1) & (slots_.size() - 1);
    if (slots_[at] != none) {
      entries_[slots_[at]].value += value;
      return;
    }
    slots_[at] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({column, value});
    if (2 * entries_.size() > slots_.size()) grow();
  }
  void clear() {
    if (4 * entries_.size() > slots_.size()) {
      std::fill(slots_.begin(), slots_.end(), none);
    } else {
      // From the last one on, so that a chain of slots is whole until all behind it are gone.
      for (std::size_t k = entries_.size(); k-- > 0;) {
        std::size_t at = slot(entries_[k].column);
        while (slots_[at] != k) at = (at + 1) & (slots_.size() - 1);
        slots_[at] = none;
      }
    }
    entries_.clear();
  }
  [[nodiscard]] std::span<const Entry> entries() const noexcept { return entries_; }

 private:
  static constexpr auto none = static_cast<std::uint32_t>(-1);

  [[nodiscard]] std::size_t slot(std::uint32_t column) const noexcept {
    // Knuth's multiplicative hash.
    return (column * 2654435769U >> 7U) & (slots_.size() - 1);
  }
  void grow() {
    slots_.assign(2 * slots_.size(), none);
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      std::size_t at = slot(entries_[k].column);
      while (slots_[at] != none) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = static_cast<std::uint32_t>(k);
    }
  }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(256, none);
};

/// image = row · matrix.
template <typename Scalar>
void multiply(std::span<const SparseRows::Entry> row, const BasicSparseRows<Scalar>& matrix, SparseSum& image) {
  image.clear();
  for (const SparseRows::Entry& outer : row) {
    for (const auto& inner : matrix.row(outer.column)) image.add(inner.column, outer.value * inner.value);
  }
}

/// a b. Cost: the multiplications.
inline SparseRows product(const SparseRows& a, const SparseRows& b, ThreadTeam& team) {
  return SparseRows::build(team, a.rows(), b.columns(), [&] {
    return [&, sum = SparseSum()](std::size_t i, SparseRows::Row& row) mutable {
      multiply(a.row(i), b, sum);
      row.insert(row.end(), sum.entries().begin(), sum.entries().end());
    };
  });
}

}  // namespace vspring
