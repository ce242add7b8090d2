#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace vspring {

/// The matrix Gᵀ G of a banded G with at most three entries per row, and perhaps a few rows that join far columns;
/// stored as the triangle of its orthogonal factorisation. Forming Gᵀ G would square the condition of G, which is n² if
/// rows are curvatures along n nodes; the triangle still solves where Gᵀ G in double precision is no longer definite.
class BandedQr {
 public:
  static constexpr std::size_t width = 3;

  /// size: number of columns.
  explicit BandedQr(std::size_t size) : rows_(size, std::array<double, width>{}) {}

  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

  /// Adds a row with entries at columns first, first + 1, first + 2; those beyond the last must be zero. Rows must come
  /// with `first` not descending. Cost: at most three rotations (Givens).
  void add_row(std::size_t first, std::array<double, width> entries);

  struct Entry {
    std::size_t column;
    double value;
  };
  /// Adds a row that joins far columns, or removes it if sign is −1. Call it after add_row(); the banded rows must have
  /// full rank. Cost: linear.
  void add_low_rank_row(std::vector<Entry> entries, double sign = 1);

  /// Solves in place, for two right-hand sides at once. Cost: linear.
  void solve(std::span<Eigen::Vector2d> right) const;

 private:
  template <typename Value>
  void solve_banded(std::span<Value> right) const;

  std::vector<std::array<double, width>> rows_;  // of the triangle: the diagonal entry and the two right of it
  struct FarRow {
    std::vector<Entry> entries;
    double sign;
    std::vector<double> solution;  // of the banded part, with the row as right-hand side
  };
  std::vector<FarRow> far_;
  Eigen::MatrixXd far_system_;  // the inverse of the matrix between far rows (Woodbury)
};

}  // namespace vspring
