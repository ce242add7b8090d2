#include "spring/model.hpp"

#include "spring/shares.hpp"
#include "spring/spacing.hpp"

namespace vspring {

void update_directions(Net& net, const Model& model, ThreadTeam& team) {
  net.whole_faces.measure(net.positions);
  parallel_ranges(team, net.computed, nodes_per_task,
                  [&](std::size_t begin, std::size_t end) { model.update_directions(net, begin, end); });
  if (!net.spheres.on()) return;
  parallel_ranges(team, net.computed, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (net.normal_given(i)) find_given_curvature(net, i);
    }
  });
}

void set_laplacian_weights(Net& net, const Model& model, Distribution distribution, ThreadTeam& team) {
  net.laplacian_weights.clear();
  if (distribution == Distribution::even) return;
  if (distribution == Distribution::smooth) {
    const auto places = net.is_curve ? rest_positions(net, team) : told_rest_positions(net, team);
    if (places) net.laplacian_weights = laplacian_weights_at(net, *places, team);
    return;
  }
  update_directions(net, model, team);
  net.laplacian_weights = model.present_laplacian_weights(net);
}

}  // namespace vspring
