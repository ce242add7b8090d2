#include <algorithm>

#include "levels/levels.hpp"
#include "levels/surface_slide.hpp"
#include "spring/sliding.hpp"

namespace vspring {

namespace {

// Passes over a shape that was handed up, until its nodes are about where the regularisation (§4.4) wants them. A sweep
// instead would move nodes in their tangent planes, off curved surfaces by the square of their way.
constexpr int passes = 3;

void put(Net& net, std::size_t i, const Place& place) {
  if (i < net.moving) put_at(net, i, place.position);
  if (!net.normal_given(i)) net.normals[i] = place.normal;
}

bool slides_at_rim(const Net& net, std::size_t i) { return net.slides(i) && on_boundary(net.rings.links(i)); }

/// Places the nodes that a coarser level lacks.
void place_removed(Net& net, const Removals& removals) {
  for (std::size_t k = removals.size(); k-- > 0;) {
    const std::size_t i = removals.nodes[k];
    const auto parents = removals.parents_of(k);
    const bool at_rim = slides_at_rim(net, i) && parents.size() > 2;
    const double weight = at_rim ? 0.5 : 1 / static_cast<double>(parents.size());
    const Place place = balance(net, [&](const auto& use) {
      if (at_rim) {
        // Those before and after it at the rim: others would draw it in along its support.
        use(parents.front(), weight);
        use(parents.back(), weight);
        return;
      }
      for (const std::uint32_t j : parents) use(j, weight);
    });
    put(net, i, place);
  }
}

/// Places every moving node anew between itself and its neighbours.
void relax(Net& net, std::vector<Place>& places, ThreadTeam& team) {
  places.resize(net.moving);
  parallel_ranges(team, net.moving, light_nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      const auto shares = net.weights_of(i);
      const auto spokes =
          static_cast<double>(std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }));
      const double own = 1 / (spokes + 1);
      places[i] = balance(net, [&](const auto& use) {
        use(i, own);
        for (std::size_t k = 0; k < links.size(); ++k) {
          if (links[k].spoke()) use(links[k].node(), shares.empty() ? own : (1 - own) * shares[k]);
        }
      });
    }
  });
  parallel_ranges(team, net.moving, light_nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!slides_at_rim(net, i)) put(net, i, places[i]);
    }
  });
}

}  // namespace

void prolong_surface(const Level& coarse, Level& fine, ThreadTeam& team) {
  const Net& from = coarse.net;
  Net& to = fine.net;
  parallel_ranges(team, coarse.finer.size(), light_nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = coarse.finer[k];
      if (k < from.moving) to.positions[i] = from.positions[k];
      if (!to.normal_given(i)) to.normals[i] = from.normals[k];
    }
  });
  place_removed(to, coarse.removals.back());
  const std::size_t groups = coarse.removals.size() - 1;
  team.run(groups, [&](std::size_t g) { place_removed(to, coarse.removals[g]); });
  std::vector<Place> places;
  for (int pass = 0; pass < passes; ++pass) relax(to, places, team);
}

}  // namespace vspring
