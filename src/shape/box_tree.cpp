#include "shape/box_tree.hpp"

#include <algorithm>
#include <numeric>

#include "base/cancellation.hpp"

namespace vspring {

BoxTree::BoxTree(std::vector<Box> boxes, ThreadTeam& team) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  while (leaves_ * items_per_leaf < boxes_.size()) leaves_ *= 2;
  for (std::size_t parts = 1; parts < leaves_; parts *= 2)
    team.run(parts, [&](std::size_t part) { split(part, parts); });
  tree_.resize(2 * leaves_ - 1);
  constexpr std::size_t leaves_per_task = 1024;
  parallel_ranges(team, leaves_, leaves_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      for (const Index item : leaf_items(leaf)) tree_[leaves_ - 1 + leaf].extend(box(item));
    }
  });
  for (std::size_t node = leaves_ - 1; node-- > 0;) tree_[node] = tree_[2 * node + 1].merged(tree_[2 * node + 2]);
}

void BoxTree::split(std::size_t part, std::size_t parts) {
  const std::size_t begin = first_item(part, parts);
  const std::size_t end = first_item(part + 1, parts);
  Box centres;
  for (std::size_t k = begin; k < end; ++k) centres.extend(box(items_[k]).center());
  if (centres.isEmpty()) return;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  end_if_cancelled();
  // Pairs, so that sorting reads memory in sequence.
  std::vector<std::pair<double, Index>> order(end - begin);
  for (std::size_t k = begin; k < end; ++k)
    order[k - begin] = {box(items_[k]).min()[axis] + box(items_[k]).max()[axis], items_[k]};
  const auto middle = static_cast<std::ptrdiff_t>(first_item(2 * part + 1, 2 * parts) - begin);
  std::nth_element(order.begin(), order.begin() + middle, order.end());
  for (std::size_t k = begin; k < end; ++k) items_[k] = order[k - begin].second;
}

}  // namespace vspring
