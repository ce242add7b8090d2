#include "fit/unfolding.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "checks/result_check.hpp"

namespace vspring {

namespace {

// Of the way to the neighbours' mean, forth and back.
constexpr double forth = 0.5;
constexpr double back = -0.53;
constexpr int filter_steps = 20;
// Of all edges: where fewer turn, they may be what the shape is like.
constexpr double least_folded = 0.005;
// Of those that turned: where more still do, it was no noise.
constexpr double most_left = 0.1;

// Around what still turns: steps towards the neighbours' mean.
constexpr int most_rounds = 20;
constexpr int local_steps = 3;
constexpr int rings_around = 1;

std::vector<std::uint8_t> with_neighbours(const Net& net, const std::vector<std::uint8_t>& nodes) {
  std::vector<std::uint8_t> result = nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] == 0) continue;
    for (const Link link : net.rings.links(i)) {
      if (link.node() < result.size()) result[link.node()] = 1;
    }
  }
  return result;
}

}  // namespace

void unfold(Net& net, ThreadTeam& team) {
  const double links = static_cast<double>(net.rings.link_count());
  const auto turned = static_cast<double>(turned_edges(net, team));
  if (turned < 0.5 * least_folded * links || turned == 0) return;
  const std::vector<Vector3> before = net.positions;
  std::vector<Vector3> next = net.positions;
  const auto step = [&](double share, const std::vector<std::uint8_t>& where) {
    parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        next[i] = where.empty() || where[i] != 0
                      ? Vector3(net.positions[i] + share * (mean_of_neighbours(net, i) - net.positions[i]))
                      : net.positions[i];
    });
    net.positions.swap(next);
  };
  for (int k = 0; k < filter_steps; ++k) {
    step(forth, {});
    step(back, {});
  }
  if (static_cast<double>(turned_edges(net, team)) > most_left * turned) {
    net.positions = before;
    return;
  }
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<std::uint8_t> where = nodes_at_turned_edges(net, team);
    if (std::find(where.begin(), where.end(), 1) == where.end()) break;
    for (int k = 0; k < rings_around; ++k) where = with_neighbours(net, where);
    for (int k = 0; k < local_steps; ++k) step(forth, where);
  }
}

}  // namespace vspring
