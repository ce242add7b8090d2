#include "solve/bending_matrix.hpp"

#include <cmath>

namespace vspring {

void BendingMatrix::add_row(std::size_t first, std::array<double, width> entries) {
  for (std::size_t column = first; column < rows_.size(); ++column) {
    auto& row = rows_[column];
    if (entries[0] != 0) {
      if (row[0] == 0) {
        row = entries;
        return;
      }
      const double length = std::sqrt(row[0] * row[0] + entries[0] * entries[0]);
      const double cosine = row[0] / length;
      const double sine = entries[0] / length;
      for (std::size_t k = 0; k < width; ++k) {
        const double above = row[k];
        row[k] = cosine * above + sine * entries[k];
        entries[k] = cosine * entries[k] - sine * above;
      }
    }
    entries = {entries[1], entries[2], 0};
    if (entries[0] == 0 && entries[1] == 0) return;
  }
}

void BendingMatrix::add_closing_row(double first, double last) {
  closing_first_ = first;
  closing_last_ = last;
  closing_solution_.assign(rows_.size(), 0);
  closing_solution_.front() += first;
  closing_solution_.back() += last;
  solve_banded<double>(closing_solution_);
  closing_denominator_ = 1 + first * closing_solution_.front() + last * closing_solution_.back();
}

template <typename Value>
void BendingMatrix::solve_banded(std::span<Value> right) const {
  const std::size_t size = rows_.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) right[i] -= rows_[i - 1][1] * right[i - 1];
    if (i > 1) right[i] -= rows_[i - 2][2] * right[i - 2];
    // A column that no row touches is left alone.
    if (rows_[i][0] != 0) right[i] *= 1 / rows_[i][0];
  }
  for (std::size_t i = size; i-- > 0;) {
    if (i + 1 < size) right[i] -= rows_[i][1] * right[i + 1];
    if (i + 2 < size) right[i] -= rows_[i][2] * right[i + 2];
    if (rows_[i][0] != 0) right[i] *= 1 / rows_[i][0];
  }
}

void BendingMatrix::solve(std::span<Eigen::Vector2d> right) const {
  solve_banded(right);
  if (closing_solution_.empty()) return;
  // Sherman and Morrison.
  const Eigen::Vector2d share = (closing_first_ * right.front() + closing_last_ * right.back()) / closing_denominator_;
  for (std::size_t i = 0; i < rows_.size(); ++i) right[i] -= closing_solution_[i] * share;
}

}  // namespace vspring
