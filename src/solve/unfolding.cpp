#include "solve/unfolding.hpp"

#include <vector>

#include "solve/soundness.hpp"

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

}  // namespace

void unfold(Net& net, ThreadTeam& team) {
  const double links = static_cast<double>(net.rings.link_count());
  const auto turned = static_cast<double>(turned_edges(net, team));
  if (turned < 0.5 * least_folded * links) return;
  const std::vector<Vector3> before = net.positions;
  std::vector<Vector3> next = net.positions;
  const auto step = [&](double share) {
    parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        next[i] = net.positions[i] + share * (mean_of_neighbours(net, i) - net.positions[i]);
    });
    net.positions.swap(next);
  };
  for (int k = 0; k < filter_steps; ++k) {
    step(forth);
    step(back);
  }
  if (static_cast<double>(turned_edges(net, team)) > most_left * turned) net.positions = before;
}

}  // namespace vspring
