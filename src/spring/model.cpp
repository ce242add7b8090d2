#include "spring/model.hpp"

namespace vspring {

void update_directions(Net& net, const Model& model, ThreadTeam& team) {
  parallel_ranges(team, net.computed, nodes_per_task,
                  [&](std::size_t begin, std::size_t end) { model.update_directions(net, begin, end); });
}

void distribute(Net& net, const Model& model, Distribution distribution, ThreadTeam& team, bool unfold) {
  net.shares.clear();
  if (distribution == Distribution::even) return;
  update_directions(net, model, team);
  net.shares = model.present_shares(net, unfold);
}

}  // namespace vspring
