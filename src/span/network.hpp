#pragma once

#include <span>
#include <utility>
#include <vector>

#include "vspring/polygon_curve.hpp"

namespace vspring {

/// Curves that are joined where they meet, as a graph.
struct Network {
  std::vector<Vector3> places;             ///< of its nodes
  std::vector<Index> from;                 ///< per node the first one of the input that is there; −1: curves cross
  std::vector<std::vector<Index>> joined;  ///< per node those at the other ends of its edges; ascending
  std::vector<std::pair<Index, Index>> sharp;  ///< edges of sharp curves, the smaller node first; ascending
  std::vector<Index> loose;                    ///< nodes of the input at which a curve ends freely; ascending

  [[nodiscard]] const std::vector<Index>& neighbours(Index node) const {
    return joined[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] const Vector3& place(Index node) const { return places[static_cast<std::size_t>(node)]; }
};

/// Joins curves that come within `tolerance` of each other, also between nodes: an end goes to the curve that it meets,
/// curves that go on meet halfway. Takes out what ends freely, up to the next junction. Coordinates must be finite.
/// Cost: n log n. sharp: the chains that are.
Network join_curves(const PolygonCurve& curves, double tolerance, std::span<const Index> sharp = {});

}  // namespace vspring
