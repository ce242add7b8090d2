#include "shape/point_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace vspring {

PointTree::PointTree(std::span<const Vector3> points) : points_(points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!points.empty()) build(0, 0, static_cast<Index>(points.size()));
}

void PointTree::build(std::size_t box, Index begin, Index end) {
  if (boxes_.size() <= box) boxes_.resize(box + 1);
  Box made{points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(begin)])], {}, begin, end};
  made.high = made.low;
  for (Index k = begin; k < end; ++k) {
    const Vector3& place = points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
    made.low = made.low.cwiseMin(place);
    made.high = made.high.cwiseMax(place);
  }
  boxes_[box] = made;
  if (end - begin <= points_per_leaf) return;
  Eigen::Index axis = 0;
  (made.high - made.low).maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](Index a, Index b) {
    return std::pair(points_[static_cast<std::size_t>(a)][axis], a) <
           std::pair(points_[static_cast<std::size_t>(b)][axis], b);
  });
  build(2 * box + 1, begin, middle);
  build(2 * box + 2, middle, end);
}

double PointTree::square_to(const Box& box, const Vector3& place) const {
  return ((box.low - place).cwiseMax(place - box.high).cwiseMax(0)).squaredNorm();
}

template <typename Passes, typename Use>
void PointTree::visit(const Vector3& place, const double& bound, const Passes& passes, const Use& use) const {
  constexpr std::size_t most_levels = 64;
  std::array<std::pair<std::size_t, double>, most_levels> stack;
  std::size_t height = 0;
  if (!boxes_.empty()) stack[height++] = {0, 0.0};
  while (height > 0) {
    const auto [number, square] = stack[--height];
    const Box& box = boxes_[number];
    if (square > bound || passes(box)) continue;
    if (box.end - box.begin <= points_per_leaf) {
      for (Index k = box.begin; k < box.end; ++k) use(order_[static_cast<std::size_t>(k)]);
      continue;
    }
    std::pair<std::size_t, double> nearer{2 * number + 1, square_to(boxes_[2 * number + 1], place)};
    std::pair<std::size_t, double> further{2 * number + 2, square_to(boxes_[2 * number + 2], place)};
    if (further.second < nearer.second) std::swap(nearer, further);
    stack[height++] = further;
    stack[height++] = nearer;
  }
}

void PointTree::nearest(Index point, std::size_t count, std::vector<Near>& found) const {
  found.clear();
  if (count == 0) return;
  const Vector3& place = points_[static_cast<std::size_t>(point)];
  double bound = std::numeric_limits<double>::infinity();
  // A heap with the furthest one on top.
  visit(
      place, bound, [](const Box&) { return false; },
      [&](Index other) {
        const Near near{(points_[static_cast<std::size_t>(other)] - place).squaredNorm(), other};
        if (other == point || (found.size() == count && !(near < found.front()))) return;
        if (found.size() == count) {
          std::pop_heap(found.begin(), found.end());
          found.pop_back();
        }
        found.push_back(near);
        std::push_heap(found.begin(), found.end());
        if (found.size() == count) bound = found.front().square;
      });
  std::sort_heap(found.begin(), found.end());
}

void PointTree::within(const Vector3& place, double radius, std::vector<Index>& found) const {
  found.clear();
  const double bound = radius * radius;
  visit(
      place, bound, [](const Box&) { return false; },
      [&](Index other) {
        if ((points_[static_cast<std::size_t>(other)] - place).squaredNorm() <= bound) found.push_back(other);
      });
}

void PointTree::set_groups(std::span<const Index> groups) {
  groups_ = groups;
  for (std::size_t number = boxes_.size(); number-- > 0;) {
    Box& box = boxes_[number];
    if (box.begin == box.end) continue;
    const auto group_of = [&](Index k) {
      return groups[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
    };
    if (box.end - box.begin > points_per_leaf) {
      const Index left = boxes_[2 * number + 1].group;
      box.group = left == boxes_[2 * number + 2].group ? left : many;
      continue;
    }
    box.group = group_of(box.begin);
    for (Index k = box.begin; k < box.end; ++k) {
      if (group_of(k) != box.group) box.group = many;
    }
  }
}

void PointTree::nearest_of_others(Index point, Near& best) const {
  const Vector3& place = points_[static_cast<std::size_t>(point)];
  const Index own = groups_[static_cast<std::size_t>(point)];
  visit(
      place, best.square, [&](const Box& box) { return box.group == own; },
      [&](Index other) {
        if (groups_[static_cast<std::size_t>(other)] == own) return;
        best = std::min(best, Near{(points_[static_cast<std::size_t>(other)] - place).squaredNorm(), other});
      });
}

}  // namespace vspring
