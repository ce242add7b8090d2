#include "solve/sphere_suited.hpp"

#include "equilibrium/equilibrium_method.hpp"

namespace vspring {

namespace {

/// Moving nodes of a walk around a node, as runs between others.
std::size_t moving_runs(const Net& net, std::span<const Link> links) {
  std::size_t runs = 0;
  bool all_move = !links.empty();
  for (std::size_t k = 0; k < links.size(); ++k) {
    const bool moves = links[k].node() < net.moving;
    const Link before = links[(k + links.size() - 1) % links.size()];
    const bool goes_on = before.node() < net.moving && !links[k].start();
    runs += moves && !goes_on ? 1 : 0;
    all_move = all_move && moves;
  }
  // All around, without an end: on both sides of any line through the node.
  return all_move && runs == 0 ? 2 : runs;
}

}  // namespace

bool suits_sphere_springs(const Net& net) {
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    const bool open = links.empty() || links.front().start();
    const bool slides_at_rim = net.slides(i) && open && !links.empty();
    if (i < net.moving && (open || net.normal_given(i)) && !slides_at_rim) return false;
    if (net.normal_given(i) && moving_runs(net, links) > 1) return false;
  }
  return !is_underconstrained(net);
}

}  // namespace vspring
