#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace vspring {

/// The triangle R of an orthogonal factorisation (Givens) of rows whose entries lie within a few columns: Rᵀ R is the
/// sum of their products, whose condition it does not square. For third differences along n nodes that is n³ in place
/// of n⁶.
class BandTriangle {
 public:
  /// Columns within which the entries of a row lie.
  static constexpr std::size_t most_width = 14;
  using Row = std::array<double, most_width>;

  BandTriangle(std::size_t size, std::size_t width) : rows_(size), width_(width) { clear(0); }

  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

  /// diagonal: what there is in each column at the start.
  void clear(double diagonal) {
    for (Row& row : rows_) {
      row.fill(0);
      row[0] = diagonal;
    }
  }

  /// A row, times a factor, whose entries begin at column `first`: in the order of these, or it takes as many rotations
  /// as there are columns below. Calls rotate(column, cosine, sine) for each rotation
  /// of a row of the triangle with it: for right-hand sides. Cost: width².
  template <typename Rotate>
  void add(std::size_t first, Row left, double factor, Rotate rotate) {
    for (std::size_t k = 0; k < width_; ++k) left[k] *= factor;
    std::size_t rest = width_;
    for (std::size_t column = first; column < rows_.size() && rest > 0; ++column) {
      Row& above = rows_[column];
      // What is left of a row dwindles along the band, until its square is no number any more.
      if (left[0] * left[0] >= std::numeric_limits<double>::min()) {
        const double length = std::sqrt(above[0] * above[0] + left[0] * left[0]);
        const double cosine = above[0] / length;
        const double sine = left[0] / length;
        above[0] = length;
        for (std::size_t k = 1; k < width_; ++k) {
          const double a = above[k];
          above[k] = cosine * a + sine * left[k];
          left[k] = cosine * left[k] - sine * a;
        }
        rotate(column, cosine, sine);
      } else {
        --rest;
      }
      for (std::size_t k = 0; k + 1 < width_; ++k) left[k] = left[k + 1];
      left[width_ - 1] = 0;
    }
  }
  void add(std::size_t first, const Row& row, double factor) {
    add(first, row, factor, [](std::size_t, double, double) {});
  }

  [[nodiscard]] const Row& row(std::size_t column) const { return rows_[column]; }

  /// R x = right, in place. Value: a number or a vector.
  template <typename Value>
  void solve_upper(std::span<Value> right) const {
    for (std::size_t i = size(); i-- > 0;) {
      for (std::size_t k = 1; k < width_ && i + k < size(); ++k) right[i] -= rows_[i][k] * right[i + k];
      right[i] *= 1 / rows_[i][0];
    }
  }

  /// Rᵀ R x = right, in place.
  void solve(std::span<double> right) const {
    for (std::size_t i = 0; i < size(); ++i) {
      right[i] /= rows_[i][0];
      for (std::size_t k = 1; k < width_ && i + k < size(); ++k) right[i + k] -= rows_[i][k] * right[i];
    }
    solve_upper(right);
  }

 private:
  std::vector<Row> rows_;  // the diagonal and what is right of it
  std::size_t width_;
};

}  // namespace vspring
