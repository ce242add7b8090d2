#include "closed_chains.hpp"

#include <utility>

namespace vspring::cli {

std::vector<Repeat> close_chains(PolygonCurve& curve) {
  std::vector<Repeat> repeats;
  std::vector<PolygonCurve::Chain> chains = curve.chains();
  for (auto& chain : chains) {
    if (chain.closed || chain.nodes.size() < 2) continue;
    const Repeat repeat{.node = chain.nodes.back(), .of = chain.nodes.front()};
    chain.closed = true;
    if (curve.position(repeat.node) != curve.position(repeat.of)) continue;
    chain.nodes.pop_back();
    if (repeat.node != repeat.of) repeats.push_back(repeat);
  }
  curve = PolygonCurve(curve.positions(), std::move(chains));
  return repeats;
}

}  // namespace vspring::cli
