#include "constraints/sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "shape/corners.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

Sides cut_into_sides(const PolygonCurve& curve, const Constraints& constraints, std::span<const Index> others) {
  std::vector<std::uint8_t> corners = marked_corners(others, curve.node_count());
  Constraints held = constraints;
  for (Index node = 0; node < curve.node_count(); ++node) {
    std::uint8_t& is_corner = corners[static_cast<std::size_t>(node)];
    if (constraints.corner(node)) is_corner = 1;
    if (constraints.tangent_fixed(node) || constraints.normal_fixed(node)) is_corner = 0;
    if (is_corner != 0 && !constraints.position_fixed(node)) held.fix_position(node, curve.position(node));
  }
  return {cut_at_corners(curve, corners), std::move(held),
          static_cast<Index>(std::count(corners.begin(), corners.end(), 1))};
}

void check_corners(const PolygonCurve& curve, const Constraints& constraints) {
  if (constraints.node_count() != curve.node_count())
    throw Error(ErrorCode::invalid_argument, fmt::format("constraints are for {} nodes, the curve has {}",
                                                         constraints.node_count(), curve.node_count()));
  if (constraints.corner_count() == 0) return;
  const std::vector<std::uint8_t> ends = boundary_nodes(curve);
  std::vector<Index> passes(ends.size(), 0);
  for (const auto& chain : curve.chains()) {
    for (const Index node : chain.nodes) ++passes[static_cast<std::size_t>(node)];
  }
  for (Index node = 0; node < constraints.node_count(); ++node) {
    if (!constraints.corner(node)) continue;
    const auto i = static_cast<std::size_t>(node);
    const auto refuse = [&](const char* reason) {
      throw Error(ErrorCode::unusable_constraint, fmt::format("node {} cannot be a corner: {}", node, reason));
    };
    if (passes[i] == 0) refuse("no chain goes through it");
    if (ends[i] != 0) refuse("a chain ends there, and has one side; give it a \"tangent\", or close the chain");
    if (passes[i] > 1) refuse("chains meet there, so it has more sides than two; hold its position, which is enough");
    if (constraints.normal_fixed(node))
      refuse("its normal is given, which has one direction; free that, and give \"tangent_in\" and \"tangent_out\"");
  }
}

std::array<Vector3, 2> given_tangents(const Constraints& constraints, Index node) {
  const auto given = [&](NodeSide side) -> Vector3 {
    return constraints.tangent_fixed(node, side) ? constraints.tangent(node, side) : Vector3::Zero();
  };
  return {given(NodeSide::before), given(NodeSide::after)};
}

Index tangents_given(const Constraints& constraints, Index node) {
  if (constraints.tangent_fixed(node)) return 1;
  return static_cast<Index>(std::count_if(std::begin(node_sides), std::end(node_sides),
                                          [&](NodeSide side) { return constraints.tangent_fixed(node, side); }));
}

}  // namespace vspring
