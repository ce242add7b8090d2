#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace vspring {

/// The matrix Gᵀ G of a banded G with at most three entries per row, and perhaps a few rows that join far columns; kept
/// as the triangle of its orthogonal factorisation. Forming Gᵀ G squares the condition of G, which is n² where rows are
/// curvatures along n nodes; the triangle never does, so it still solves where Gᵀ G in double precision is no longer
/// definite.
class BandedQr {
 public:
  static constexpr std::size_t width = 3;

  /// size: number of columns.
  explicit BandedQr(std::size_t size) : rows_(size, std::array<double, width>{}) {}

  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

  /// Adds a row with entries at columns first, first + 1, first + 2; those beyond the last must be zero. Rows come with
  /// `first` never descending. Cost: at most three rotations (Givens).
  void add_row(std::size_t first, std::array<double, width> entries);

  struct Entry {
    std::size_t column;
    double value;
  };
  /// Adds a row that joins far columns, or takes it out again where sign is −1. After all others; the banded ones must
  /// have full rank. Cost: linear.
  void add_low_rank_row(std::vector<Entry> entries, double sign = 1);

  /// Solves in place, for two right-hand sides at once. Cost: linear.
  void solve(std::span<Eigen::Vector2d> right) const;

 private:
  template <typename Value>
  void solve_banded(std::span<Value> right) const;

  std::vector<std::array<double, width>> rows_;  // of the triangle: the diagonal and the two entries right of it
  struct FarRow {
    std::vector<Entry> entries;
    double sign;
    std::vector<double> solution;  // of the banded part, with the row as right-hand side
  };
  std::vector<FarRow> far_;
  Eigen::MatrixXd far_system_;  // the inverse of what they leave of each other
};

}  // namespace vspring
