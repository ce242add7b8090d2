#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/threads.hpp"

namespace vspring {

/// A sparse matrix, row by row.
class SparseRows {
 public:
  struct Entry {
    std::uint32_t column;
    double value;
  };
  using Row = std::vector<Entry>;

  SparseRows() = default;

  /// From rows that are made side by side. make_worker() gives a function (i, row) that appends the entries of row i;
  /// each is called for successive rows of one run. A column may occur once in a row.
  template <typename MakeWorker>
  static SparseRows build(ThreadTeam& team, std::size_t rows, std::size_t columns, const MakeWorker& make_worker) {
    SparseRows matrix;
    matrix.columns_ = columns;
    matrix.begin_.assign(rows + 1, 0);
    std::vector<std::vector<Entry>> runs((rows + rows_per_task - 1) / rows_per_task);
    parallel_ranges(team, rows, rows_per_task, [&](std::size_t begin, std::size_t end) {
      auto worker = make_worker();
      auto& run = runs[begin / rows_per_task];
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t before = run.size();
        worker(i, run);
        matrix.begin_[i + 1] = static_cast<std::uint32_t>(run.size() - before);
      }
    });
    std::partial_sum(matrix.begin_.begin(), matrix.begin_.end(), matrix.begin_.begin());
    matrix.entries_.resize(matrix.begin_.back());
    team.run(runs.size(), [&](std::size_t k) {
      std::copy(runs[k].begin(), runs[k].end(), matrix.entries_.begin() + matrix.begin_[k * rows_per_task]);
    });
    return matrix;
  }

  [[nodiscard]] std::size_t rows() const noexcept { return begin_.size() - 1; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::span<const Entry> row(std::size_t i) const {
    return {entries_.data() + begin_[i], begin_[i + 1] - begin_[i]};
  }
  [[nodiscard]] double diagonal(std::size_t i) const;

  /// Columns in ascending order in every row. Cost: linear.
  [[nodiscard]] SparseRows transposed() const;
  [[nodiscard]] Eigen::SparseMatrix<double> to_eigen() const;

 private:
  static constexpr std::size_t rows_per_task = 8192;
  std::size_t columns_ = 0;
  std::vector<std::uint32_t> begin_ = {0};
  std::vector<Entry> entries_;
};

/// a b. Cost: the multiplications, and the columns of b for every 8192 rows.
SparseRows product(const SparseRows& a, const SparseRows& b, ThreadTeam& team);

}  // namespace vspring
