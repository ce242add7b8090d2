#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linear/sparse_rows.hpp"

namespace vspring {

/// A row while it is summed up; columns in the order in which they came. Nothing branches on whether a column is new,
/// which cannot be predicted.
class SparseSum {
 public:
  /// columns: their number. Cost: linear in them, once.
  explicit SparseSum(std::size_t columns) : place_(columns, none) {}

  void add(std::uint32_t column, double value) {
    const std::uint32_t before = place_[column];
    const bool is_new = before == none;
    const std::uint32_t at = is_new ? static_cast<std::uint32_t>(size_) : before;
    place_[column] = at;
    columns_[size_] = column;
    values_[at] += value;
    size_ += is_new ? 1 : 0;
    if (size_ == columns_.size()) grow();
  }
  /// Cost: linear in its entries.
  void clear() {
    for (std::size_t k = 0; k < size_; ++k) {
      place_[columns_[k]] = none;
      values_[k] = 0;
    }
    size_ = 0;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Calls use(column, value) for every entry.
  template <typename Use>
  void for_each(const Use& use) const {
    for (std::size_t k = 0; k < size_; ++k) use(columns_[k], values_[k]);
  }

 private:
  static constexpr auto none = static_cast<std::uint32_t>(-1);
  static constexpr std::size_t first_room = 256;

  void grow() {
    columns_.resize(2 * columns_.size());
    values_.resize(columns_.size(), 0);
  }

  std::vector<std::uint32_t> place_;  // per column its place among the entries, or none
  std::size_t size_ = 0;              // of another type than the stored arrays, so it stays in a register
  // With space for one more entry; values of future entries are zero.
  std::vector<std::uint32_t> columns_ = std::vector<std::uint32_t>(first_room);
  std::vector<double> values_ = std::vector<double>(first_room, 0);
};

/// The product a b. Cost: linear in the multiplications.
inline SparseRows product(const SparseRows& a, const SparseRows& b, ThreadTeam& team) {
  return SparseRows::build(team, a.rows(), b.columns(), [&] {
    return [&, sum = SparseSum(b.columns())](std::size_t i, SparseRows::Row& row) mutable {
      sum.clear();
      for (const SparseRows::Entry& outer : a.row(i)) {
        for (const SparseRows::Entry& inner : b.row(outer.column)) sum.add(inner.column, outer.value * inner.value);
      }
      sum.for_each([&](std::uint32_t column, double value) { row.push_back({column, value}); });
    };
  });
}

}  // namespace vspring
