#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace vspring {

/// The triangle R of an orthogonal factorisation (Givens) of rows whose entries lie within a few columns. Rᵀ R is the
/// sum of products of rows, but never formed, which would square the condition: for third differences along n nodes
/// that is n³ in place of n⁶.
class BandTriangle {
 public:
  /// Most columns over which the entries of a row may extend.
  static constexpr std::size_t most_width = 14;
  using Row = std::array<double, most_width>;

  BandTriangle(std::size_t size, std::size_t width)
      : size_(size),
        // The widths of curves in the plane and in space, open and closed.
        width_(width <= 4   ? 4
               : width <= 7 ? 7
               : width <= 8 ? 8
                            : most_width),
        entries_(size * width_) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// diagonal: the initial diagonal entry of each column.
  void clear(double diagonal) {
    std::fill(entries_.begin(), entries_.end(), 0);
    for (std::size_t i = 0; i < size_; ++i) entries_[i * width_] = diagonal;
  }

  /// Adds a row, times a factor, whose entries begin at column `first`. Rows should come with ascending `first`, else
  /// each needs as many rotations as there are later columns. Calls rotate(column, cosine, sine) for each rotation, for
  /// right-hand sides. Cost: width².
  template <typename Rotate>
  void add(std::size_t first, std::span<const double> row, double factor, Rotate rotate) {
    for_width([&](auto width) { rotate_in<width>(first, row.data(), factor, rotate); });
  }
  void add(std::size_t first, std::span<const double> row, double factor) {
    add(first, row, factor, [](std::size_t, double, double) {});
  }

  /// The diagonal entry and those right of it.
  [[nodiscard]] std::span<const double> row(std::size_t column) const {
    return std::span(entries_).subspan(column * width_, width_);
  }

  /// Solves R x = right in place. Value: a number or a vector.
  template <typename Value>
  void solve_upper(std::span<Value> right) const {
    for_width([&](auto width) {
      for (std::size_t i = size_; i-- > 0;) {
        const double* entries = &entries_[i * width];
        const std::size_t count = std::min<std::size_t>(width, size_ - i);
        for (std::size_t k = 1; k < count; ++k) right[i] -= entries[k] * right[i + k];
        right[i] *= 1 / entries[0];
      }
    });
  }

  /// Solves Rᵀ R x = right in place.
  void solve(std::span<double> right) const {
    for_width([&](auto width) {
      for (std::size_t i = 0; i < size_; ++i) {
        const double* entries = &entries_[i * width];
        const std::size_t count = std::min<std::size_t>(width, size_ - i);
        right[i] /= entries[0];
        for (std::size_t k = 1; k < count; ++k) right[i + k] -= entries[k] * right[i];
      }
    });
    solve_upper(right);
  }

 private:
  /// Loops of constant length are twice as fast.
  template <typename Use>
  void for_width(Use use) const {
    switch (width_) {
      case 4:
        return use(std::integral_constant<std::size_t, 4>());
      case 7:
        return use(std::integral_constant<std::size_t, 7>());
      case 8:
        return use(std::integral_constant<std::size_t, 8>());
      default:
        return use(std::integral_constant<std::size_t, most_width>());
    }
  }

  template <std::size_t Width, typename Rotate>
  void rotate_in(std::size_t first, const double* row, double factor, Rotate& rotate) {
    std::array<double, Width> left;
    for (std::size_t k = 0; k < Width; ++k) left[k] = row[k] * factor;
    std::size_t rest = Width;
    for (std::size_t column = first; column < size_ && rest > 0; ++column) {
      double* above = &entries_[column * Width];
      // The rest of a row dwindles along the band, until its square underflows.
      if (left[0] * left[0] >= std::numeric_limits<double>::min()) {
        const double length = std::sqrt(above[0] * above[0] + left[0] * left[0]);
        const double cosine = above[0] / length;
        const double sine = left[0] / length;
        // The column is still empty.
        const bool ends = above[0] == 0;
        above[0] = length;
        for (std::size_t k = 1; k < Width; ++k) {
          const double a = above[k];
          above[k] = cosine * a + sine * left[k];
          left[k - 1] = cosine * left[k] - sine * a;
        }
        rotate(column, cosine, sine);
        if (ends) return;
      } else {
        --rest;
        for (std::size_t k = 1; k < Width; ++k) left[k - 1] = left[k];
      }
      left[Width - 1] = 0;
    }
  }

  std::size_t size_;
  std::size_t width_;
  std::vector<double> entries_;  // per row the diagonal entry and those right of it
};

}  // namespace vspring
