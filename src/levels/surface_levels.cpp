#include <algorithm>
#include <utility>

#include "base/cancellation.hpp"
#include "levels/coarsening.hpp"
#include "levels/levels.hpp"
#include "levels/patch_mesh.hpp"
#include "spring/shares.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

// Moving nodes of the coarsest level: few enough for few iterations, enough to show the shape.
constexpr std::size_t few_enough = 24;
// Fewer nodes do not show the shape.
constexpr std::size_t too_few = 6;
// A level that keeps a larger share of the nodes is not worth its work.
constexpr double worthwhile = 0.85;

/// The nodes of a finer net that a coarser one keeps, in its order: moving ones, held ones with a ring, others.
struct Selection {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> number;  ///< by the finer net's numbers
  std::size_t moving = 0;
  std::size_t computed = 0;
};

/// for_spheres: as for gather_net().
Selection select(const Net& fine, const Triangulation& triangulation, const std::vector<std::uint8_t>& kept,
                 bool for_spheres) {
  Selection selection;
  selection.number.resize(kept.size(), 0);
  std::vector<std::uint32_t> others;
  for (std::size_t i = 0; i < fine.moving; ++i) {
    if (kept[i] != 0) selection.nodes.push_back(static_cast<std::uint32_t>(i));
  }
  selection.moving = selection.nodes.size();
  for (std::size_t i = fine.moving; i < kept.size(); ++i) {
    if (kept[i] == 0) continue;
    bool beside_moving = false;
    triangulation.for_each_neighbour(i, [&](std::size_t j) { beside_moving = beside_moving || j < fine.moving; });
    (beside_moving && (for_spheres || !fine.normal_given(i)) ? selection.nodes : others)
        .push_back(static_cast<std::uint32_t>(i));
  }
  selection.computed = selection.nodes.size();
  selection.nodes.insert(selection.nodes.end(), others.begin(), others.end());
  for (std::size_t k = 0; k < selection.nodes.size(); ++k)
    selection.number[selection.nodes[k]] = static_cast<std::uint32_t>(k);
  return selection;
}

Net coarse_net(const Net& fine, const Selection& selection, const Triangulation& coarse) {
  Net net;
  const std::size_t nodes = selection.nodes.size();
  net.moving = selection.moving;
  net.computed = selection.computed;
  net.positions.reserve(nodes);
  net.normals.reserve(nodes);
  net.given.reserve(nodes);
  net.node.reserve(nodes);
  for (const std::uint32_t i : selection.nodes) {
    net.positions.push_back(fine.positions[i]);
    net.normals.push_back(fine.normals[i]);
    net.given.push_back(fine.given[i]);
    net.node.push_back(fine.node[i]);
  }
  net.rings.reserve(net.computed, 7 * net.computed);
  std::vector<Link> links;
  for (std::size_t i = 0; i < net.computed; ++i) {
    end_if_cancelled_at(i);
    coarse.add_links(i, links, net.rings);
  }
  for (std::size_t k = 0; k < net.moving && !fine.supports.empty(); ++k)
    net.supports.push_back(fine.supports[selection.nodes[k]]);
  net.frame = fine.frame;
  net.tiny = fine.tiny;
  return net;
}

}  // namespace

std::vector<Level> surface_levels(Net net, const Model& model, Distribution distribution, ThreadTeam& team) {
  // Coarser levels do not keep a distribution: it might flip faces there.
  std::vector<Vector3> places;
  if (distribution == Distribution::smooth) {
    if (auto told = told_rest_positions(net, team))
      places = std::move(*told);
    else
      distribution = Distribution::even;
  } else if (distribution != Distribution::even) {
    places = rest_positions(net, team);
  }
  if (distribution == Distribution::smooth) {
    net.laplacian_weights = laplacian_weights_at(net, places, team);
  } else {
    set_laplacian_weights(net, model, distribution, team);
  }
  std::vector<Level> levels(1);
  levels[0].net = std::move(net);
  if (levels[0].net.moving <= few_enough) return levels;
  // Coarser levels take over those of nodes that have no ring there.
  update_directions(levels[0].net, model, team);
  Triangulation triangulation(triangulated_patch(levels[0].net), team);
  for (;;) {
    const Net& fine = levels.back().net;
    std::vector<std::uint8_t> constrained(fine.given.size());
    for (std::size_t i = 0; i < constrained.size(); ++i)
      constrained[i] = static_cast<std::uint8_t>(i >= fine.moving || fine.given[i] != 0);
    std::vector<std::uint8_t> kept = choose_coarse_nodes(triangulation, constrained, places);
    end_if_cancelled();
    std::vector<Removals> removals = coarsen(triangulation, kept, team, places);
    end_if_cancelled();
    Selection selection = select(fine, triangulation, kept, levels.front().net.spheres.on());
    const bool smaller = static_cast<double>(selection.nodes.size()) <= worthwhile * static_cast<double>(kept.size());
    if (!smaller || selection.moving < too_few) break;
    triangulation = Triangulation(triangulation, selection.nodes, selection.number, team);
    Level level{coarse_net(fine, selection, triangulation), std::move(selection.nodes), std::move(removals), {}};
    if (!places.empty()) {
      std::vector<Vector3> kept_places(level.finer.size());
      for (std::size_t k = 0; k < kept_places.size(); ++k) kept_places[k] = places[level.finer[k]];
      places = std::move(kept_places);
      level.net.laplacian_weights = laplacian_weights_at(level.net, places, team, true);
      level.places = places;
    }
    levels.push_back(std::move(level));
    if (levels.back().net.moving <= few_enough) break;
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

}  // namespace vspring
