#pragma once

#include <vector>

#include "span/arcs.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// The nodes that divide the curves of a network.
struct CurveNodes {
  std::vector<Vector3> places;
  /// Per arc its nodes, ends included; of a closed one that meets no other, the first again at the end. Empty for arcs
  /// that are not divided.
  std::vector<std::vector<Index>> of_arc;

  /// Those along a half-arc.
  [[nodiscard]] std::vector<Index> along(Index half) const;
};

/// Divides arcs evenly, along cubics through their nodes, which share tangents where a curve goes on. edges: per arc
/// how many; 0 for an arc that is not divided. Cost: linear.
CurveNodes divide_curves(const Network& network, const Arcs& arcs, const std::vector<Index>& edges);

/// Fairs curves that go on through junctions, which hold them, one after the other. Their ends keep their tangents.
/// network: names them in warnings. Returns the worst outcome and all warnings. Cost: that of fair().
FairReport fair_curves(CurveNodes& nodes, const Network& network, const Arcs& arcs, const FairingMethod& method,
                       Context& context);

}  // namespace vspring
