#include "linear/banded_qr.hpp"

#include <cmath>
#include <utility>

#include "base/dense_algebra.hpp"

namespace vspring {

void BandedQr::add_row(std::size_t first, std::array<double, width> entries) {
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

void BandedQr::add_low_rank_row(std::vector<Entry> entries, double sign) {
  std::vector<double> solution(rows_.size(), 0);
  for (const Entry& entry : entries) solution[entry.column] += entry.value;
  solve_banded<double>(solution);
  far_.push_back({std::move(entries), sign, std::move(solution)});
  const auto count = static_cast<Eigen::Index>(far_.size());
  Eigen::MatrixXd system(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const FarRow& row = far_[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < count; ++b) {
      system(a, b) = a == b ? row.sign : 0;
      for (const Entry& entry : row.entries)
        system(a, b) += entry.value * far_[static_cast<std::size_t>(b)].solution[entry.column];
    }
  }
  far_system_ = inverse(system);
}

template <typename Value>
void BandedQr::solve_banded(std::span<Value> right) const {
  const std::size_t size = rows_.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) right[i] -= rows_[i - 1][1] * right[i - 1];
    if (i > 1) right[i] -= rows_[i - 2][2] * right[i - 2];
    // Skips columns without a row.
    if (rows_[i][0] != 0) right[i] *= 1 / rows_[i][0];
  }
  for (std::size_t i = size; i-- > 0;) {
    if (i + 1 < size) right[i] -= rows_[i][1] * right[i + 1];
    if (i + 2 < size) right[i] -= rows_[i][2] * right[i + 2];
    if (rows_[i][0] != 0) right[i] *= 1 / rows_[i][0];
  }
}

void BandedQr::solve(std::span<Eigen::Vector2d> right) const {
  solve_banded(right);
  if (far_.empty()) return;
  // Sherman, Morrison and Woodbury.
  Eigen::MatrixX2d images = Eigen::MatrixX2d::Zero(far_system_.rows(), 2);
  for (std::size_t a = 0; a < far_.size(); ++a) {
    for (const Entry& entry : far_[a].entries)
      images.row(static_cast<Eigen::Index>(a)) += entry.value * right[entry.column];
  }
  const Eigen::MatrixX2d shares = far_system_ * images;
  for (std::size_t a = 0; a < far_.size(); ++a) {
    const Eigen::Vector2d share = shares.row(static_cast<Eigen::Index>(a));
    for (std::size_t i = 0; i < rows_.size(); ++i) right[i] -= far_[a].solution[i] * share;
  }
}

}  // namespace vspring
