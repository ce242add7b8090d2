#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vspring {

/// Which points count in figures and tolerances. A point that is nearest to a held place, at the start and now, does
/// not: no allowed shape comes nearer to it.
class CountingPoints {
 public:
  /// Distances of the points from held places, and from the shape at the start. Without the former all points count.
  CountingPoints(std::vector<double> from_held, std::span<const double> at_start) : from_held_(std::move(from_held)) {
    if (from_held_.empty()) return;
    for (std::size_t j = 0; j < at_start.size(); ++j) is_movable_.push_back(is_movable(j, at_start[j]) ? 1 : 0);
  }

  /// 1 for those of the points `of` that count at these distances from the shape; all of them where none does.
  [[nodiscard]] std::vector<std::uint8_t> at(std::span<const double> distances,
                                             const std::vector<std::uint8_t>& of) const {
    std::vector<std::uint8_t> counts = of;
    for (std::size_t j = 0; j < from_held_.size(); ++j) {
      if (is_movable_[j] == 0 && !is_movable(j, distances[j])) counts[j] = 0;
    }
    return std::count(counts.begin(), counts.end(), 1) > 0 ? counts : of;
  }

 private:
  // Distances are measured in frames of their own.
  static constexpr double nearly_as_far = 1 - 1e-9;

  [[nodiscard]] bool is_movable(std::size_t j, double distance) const {
    return distance < nearly_as_far * from_held_[j];
  }

  std::vector<double> from_held_;
  std::vector<std::uint8_t> is_movable_;  ///< at the start
};

}  // namespace vspring
