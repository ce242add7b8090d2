#include "closed_chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

std::string note_of_repeats(const PolygonCurve& curve) {
  constexpr std::size_t fewest = 4;
  const auto repeats = [&](const PolygonCurve::Chain& chain) {
    return !chain.closed && chain.nodes.size() >= fewest && chain.nodes.front() != chain.nodes.back() &&
           curve.position(chain.nodes.front()) == curve.position(chain.nodes.back());
  };
  const auto& chains = curve.chains();
  const auto first = std::find_if(chains.begin(), chains.end(), repeats);
  if (first == chains.end()) return {};
  const auto others = std::count_if(first + 1, chains.end(), repeats);
  return fmt::format(
      "note: node {} is where node {} is{}, and the curve stays open there: with a corner, as at the trailing edge of "
      "an "
      "aerofoil, that is right; --closed makes the two one node of a smooth closed curve\n",
      first->nodes.back(), first->nodes.front(), others > 0 ? fmt::format(" (and so in {} more chains)", others) : "");
}

}  // namespace

ClosedChains::ClosedChains(PolygonCurve& curve, bool closed) {
  if (!closed) {
    note_ = note_of_repeats(curve);
    return;
  }
  std::vector<PolygonCurve::Chain> chains = curve.chains();
  for (auto& chain : chains) {
    if (chain.closed || chain.nodes.size() < 2) continue;
    const DuplicateEnd repeat{.node = chain.nodes.back(), .of = chain.nodes.front()};
    chain.closed = true;
    if (curve.position(repeat.node) != curve.position(repeat.of)) continue;
    chain.nodes.pop_back();
    if (repeat.node != repeat.of) repeats_.push_back(repeat);
  }
  curve = PolygonCurve(curve.positions(), std::move(chains));
}

void ClosedChains::hold(Constraints& constraints) const {
  for (const auto& [node, of] : repeats_) {
    if (constraints.position_fixed(node)) {
      if (constraints.position_fixed(of) && constraints.position(of) != constraints.position(node))
        throw Error(ErrorCode::unusable_constraint,
                    fmt::format("nodes {} and {} are one in the closed curve, but are held at different places; hold "
                                "one of them",
                                of, node));
      constraints.fix_position(of, constraints.position(node));
      constraints.free_position(node);
    }
    if (constraints.normal_fixed(node) && !constraints.normal_fixed(of))
      constraints.fix_normal(of, constraints.normal(node));
    if (constraints.tangent_fixed(node) && !constraints.tangent_fixed(of))
      constraints.fix_tangent(of, constraints.tangent(node));
    constraints.free_normal(node);
    constraints.free_tangent(node);
  }
}

void ClosedChains::follow(std::vector<Vector3>& positions) const {
  for (const auto& [node, of] : repeats_)
    positions[static_cast<std::size_t>(node)] = positions[static_cast<std::size_t>(of)];
}

}  // namespace vspring::cli
