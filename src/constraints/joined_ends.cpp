#include "vspring/joined_ends.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "vspring/error.hpp"

namespace vspring {

namespace {

/// Applies constraints on directions of the last row that the first does not have.
void hold_directions(Constraints& constraints, Index node, Index of) {
  if (constraints.tangent_fixed(of)) return;
  if (constraints.corner(node)) constraints.make_corner(of);
  for (const NodeSide side : node_sides) {
    if (constraints.corner(of) && constraints.tangent_fixed(node, side) && !constraints.tangent_fixed(of, side))
      constraints.fix_tangent(of, constraints.tangent(node, side), side);
  }
  if (constraints.tangent_fixed(node) && !constraints.corner(of))
    constraints.fix_tangent(of, constraints.tangent(node));
}

}  // namespace

JoinedEnds::JoinedEnds(PolygonCurve& curve, std::span<const std::uint8_t> closes) {
  std::vector<PolygonCurve::Chain> chains = curve.chains();
  if (!closes.empty() && closes.size() != chains.size())
    throw Error(ErrorCode::invalid_argument, fmt::format("{} marks of chains that are to be closed given for {} chains",
                                                         closes.size(), chains.size()));
  for (std::size_t c = 0; c < chains.size(); ++c) {
    PolygonCurve::Chain& chain = chains[c];
    if (chain.closed || chain.nodes.size() < 2 || (!closes.empty() && closes[c] == 0)) continue;
    chain.closed = true;
    const Index first = chain.nodes.front();
    const Index last = chain.nodes.back();
    if (curve.position(last) != curve.position(first)) continue;
    chain.nodes.pop_back();
    if (last != first) followers_.emplace_back(last, first);
  }
  curve = PolygonCurve(curve.positions(), std::move(chains));
}

void JoinedEnds::hold(Constraints& constraints) const {
  for (const auto& [node, of] : followers_) {
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
    hold_directions(constraints, node, of);
    constraints.free_normal(node);
    constraints.free_corner(node);
    constraints.free_tangent(node);
  }
}

void JoinedEnds::follow(std::vector<Vector3>& positions) const {
  for (const auto& [node, of] : followers_)
    positions[static_cast<std::size_t>(node)] = positions[static_cast<std::size_t>(of)];
}

}  // namespace vspring
