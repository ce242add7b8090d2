#include "sweep/sweep.hpp"

#include <algorithm>
#include <cstddef>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// Small enough that a few hundred nodes occupy several threads; large enough that handing a block out costs little
// compared to sweeping it, and that most neighbours of a node lie in its block.
constexpr std::size_t smallest_block = 64;
constexpr std::size_t largest_block = 4096;
constexpr std::size_t blocks_wanted = 64;

}  // namespace

std::vector<std::vector<Block>> parallel_order(const Net& net) {
  const std::size_t size = std::clamp(net.moving / blocks_wanted, smallest_block, largest_block);
  const std::size_t count = (net.moving + size - 1) / size;
  std::vector<std::vector<Block>> groups;
  std::vector<std::size_t> group_of(count);
  std::vector<std::size_t> taken_by;  // the last block that found a group taken by a neighbour
  // Where the mesh is not manifold, an edge between blocks may be known to one of them only, so both are noted.
  std::vector<std::vector<std::size_t>> neighbours(count);
  const auto note = [&](std::size_t a, std::size_t b) {
    if (neighbours[a].empty() || neighbours[a].back() != b) neighbours[a].push_back(b);
  };
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke() || link.node() >= net.moving || link.node() / size == i / size) continue;
      note(i / size, link.node() / size);
      note(link.node() / size, i / size);
    }
  }
  for (std::size_t b = 0; b < count; ++b) {
    taken_by.assign(groups.size() + 1, count);
    for (const std::size_t other : neighbours[b]) {
      if (other < b) taken_by[group_of[other]] = b;
    }
    std::size_t group = 0;
    while (taken_by[group] == b) ++group;
    if (group == groups.size()) groups.emplace_back();
    group_of[b] = group;
    groups[group].push_back({b * size, std::min(net.moving, (b + 1) * size)});
  }
  return groups;
}

std::vector<Block> file_order(const Net& net) {
  std::vector<Block> order;
  order.reserve(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) order.push_back({i, i + 1});
  std::sort(order.begin(), order.end(),
            [&](const Block& a, const Block& b) { return net.node[a.begin] < net.node[b.begin]; });
  return order;
}

Sweep::Sweep(Net& net, const Model& model, ThreadTeam& team, SweepOrder order)
    : net_(&net), model_(&model), team_(&team) {
  if (order == SweepOrder::file) {
    sequence_ = file_order(net);
    return;
  }
  groups_ = parallel_order(net);
  std::size_t most = 0;
  for (const auto& group : groups_) most = std::max(most, group.size());
  greatest_.resize(most);
}

double Sweep::iterate() {
  update_directions(*net_, *model_, *team_);
  double greatest = 0;
  for (std::size_t k = 0; k < sequence_.size(); ++k) {
    end_if_cancelled_at(k);
    greatest = std::max(greatest, model_->move(*net_, sequence_[k]));
  }
  for (const auto& group : groups_) {
    team_->run(group.size(), [&](std::size_t k) { greatest_[k] = model_->move(*net_, group[k]); });
    greatest = std::max(
        greatest, *std::max_element(greatest_.begin(), greatest_.begin() + static_cast<std::ptrdiff_t>(group.size())));
  }
  return greatest;
}

}  // namespace vspring
