#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/threads.hpp"

namespace vspring {

/// A sparse matrix, row by row.
template <typename Scalar>
class BasicSparseRows {
 public:
  struct Entry {
    std::uint32_t column;
    Scalar value;
  };
  using Row = std::vector<Entry>;

  BasicSparseRows() = default;

  /// From rows made in parallel. make_worker() returns a function (i, row) that appends the entries of row i; each is
  /// called for successive rows of one run. A column may occur once in a row.
  template <typename MakeWorker>
  static BasicSparseRows build(ThreadTeam& team, std::size_t rows, std::size_t columns, const MakeWorker& make_worker) {
    BasicSparseRows matrix;
    matrix.columns_ = columns;
    matrix.begin_.assign(rows + 1, 0);
    const auto make = [&](std::size_t begin, std::size_t end, Row& run) {
      auto worker = make_worker();
      for (std::size_t i = begin; i < end; ++i) {
        // A row of a node with very many neighbours takes long.
        end_if_cancelled();
        const std::size_t before = run.size();
        worker(i, run);
        matrix.begin_[i + 1] = static_cast<std::uint32_t>(run.size() - before);
      }
    };
    std::vector<Row> runs = parallel_parts(team, rows, rows_per_task, Row(), make);
    std::partial_sum(matrix.begin_.begin(), matrix.begin_.end(), matrix.begin_.begin());
    matrix.entries_ = std::unique_ptr<Entry[]>(new Entry[matrix.begin_.back()]);
    // Runs are freed as they are copied, so there are never two copies of all.
    team.run(runs.size(), [&](std::size_t k) {
      std::copy(runs[k].begin(), runs[k].end(), matrix.entries_.get() + matrix.begin_[k * rows_per_task]);
      runs[k] = Row();
    });
    return matrix;
  }

  [[nodiscard]] bool empty() const noexcept { return begin_.back() == 0; }
  [[nodiscard]] std::size_t rows() const noexcept { return begin_.size() - 1; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::span<const Entry> row(std::size_t i) const {
    return {entries_.get() + begin_[i], begin_[i + 1] - begin_[i]};
  }
  [[nodiscard]] Scalar diagonal(std::size_t i) const {
    for (const Entry& entry : row(i)) {
      if (entry.column == i) return entry.value;
    }
    return 0;
  }

  /// Columns in ascending order in every row. Cost: linear.
  [[nodiscard]] BasicSparseRows transposed() const {
    BasicSparseRows result;
    result.columns_ = rows();
    result.begin_.assign(columns_ + 1, 0);
    for (const Entry& entry : entries()) ++result.begin_[entry.column + 1];
    std::partial_sum(result.begin_.begin(), result.begin_.end(), result.begin_.begin());
    result.entries_ = std::unique_ptr<Entry[]>(new Entry[begin_.back()]);
    // Where the next entry of each row goes; in the end the end of the row, which begins the next one.
    for (std::size_t i = 0; i < rows(); ++i) {
      for (const Entry& entry : row(i))
        result.entries_[result.begin_[entry.column]++] = {static_cast<std::uint32_t>(i), entry.value};
    }
    for (std::size_t i = result.begin_.size(); i-- > 1;) result.begin_[i] = result.begin_[i - 1];
    result.begin_[0] = 0;
    return result;
  }

  [[nodiscard]] Eigen::SparseMatrix<double> to_eigen() const {
    std::vector<int> begin(begin_.begin(), begin_.end());
    std::vector<int> columns;
    std::vector<double> values;
    columns.reserve(begin_.back());
    values.reserve(begin_.back());
    for (const Entry& entry : entries()) {
      columns.push_back(static_cast<int>(entry.column));
      values.push_back(entry.value);
    }
    return Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
        static_cast<Eigen::Index>(rows()), static_cast<Eigen::Index>(columns_),
        static_cast<Eigen::Index>(values.size()), begin.data(), columns.data(), values.data());
  }

 private:
  static constexpr std::size_t rows_per_task = 8192;

  [[nodiscard]] std::span<const Entry> entries() const { return {entries_.get(), begin_.back()}; }

  std::size_t columns_ = 0;
  std::vector<std::uint32_t> begin_ = {0};
  std::unique_ptr<Entry[]> entries_;  // uninitialised: untouched pages cost nothing
};

using SparseRows = BasicSparseRows<double>;
/// In single precision, at half the size: for preconditioners of large shapes.
using FloatRows = BasicSparseRows<float>;

}  // namespace vspring
