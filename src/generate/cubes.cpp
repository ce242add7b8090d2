#include "generate/cubes.hpp"

namespace vspring::generate {

Index LatticeNodes::at(const LatticePoint& point) {
  constexpr int bits = 21;
  const auto key = static_cast<std::uint64_t>(point[0]) | static_cast<std::uint64_t>(point[1]) << bits |
                   static_cast<std::uint64_t>(point[2]) << (2 * bits);
  const auto found = numbers_.find(key);
  if (found != numbers_.end()) return found->second;
  const Index number = builder_->add_node(place_(point));
  numbers_.emplace(key, number);
  return number;
}

CubeSide::CubeSide(Side side, const LatticePoint& corner, int cells)
    : axis_(static_cast<int>(side) / 2),
      column_axis_((axis_ + 1) % 3),
      row_axis_((axis_ + 2) % 3),
      positive_(static_cast<int>(side) % 2 == 0),
      origin_(corner),
      cells_(cells) {
  if (positive_) {
    origin_[static_cast<std::size_t>(axis_)] += cells;
  } else {
    std::swap(column_axis_, row_axis_);
  }
}

LatticePoint CubeSide::point(int column, int row) const {
  LatticePoint point = origin_;
  point[static_cast<std::size_t>(column_axis_)] += column;
  point[static_cast<std::size_t>(row_axis_)] += row;
  return point;
}

LatticePoint CubeSide::around(int k) const {
  const int step = k % cells_;
  switch (k / cells_ % 4) {
    case 0:
      return point(step, 0);
    case 1:
      return point(cells_, step);
    case 2:
      return point(cells_ - step, cells_);
    default:
      return point(0, cells_ - step);
  }
}

}  // namespace vspring::generate
