#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// A polygonal curve: node positions, and chains that run through them. Most curves are one chain, open or closed; a
/// drawing has many, which may meet at fixed nodes.
///
/// Chains are fixed at construction; positions may change. Only memory safety is checked here; check_constraints() says
/// what cannot be faired.
class PolygonCurve {
 public:
  /// A run of nodes, each joined to the next.
  struct Chain {
    std::vector<Index> nodes;  ///< in order; a closed chain does not repeat its first node at the end
    bool closed = false;       ///< whether the last node is joined to the first
  };

  PolygonCurve() = default;

  /// One chain through all positions in order. From a flat array: positions_of().
  explicit PolygonCurve(std::vector<Vector3> positions, bool closed = false);

  /// Throws Error(unusable_shape) naming a chain that has a node out of range. Cost: linear.
  PolygonCurve(std::vector<Vector3> positions, std::vector<Chain> chains);

  /// Number of nodes, those of no chain among them.
  [[nodiscard]] Index node_count() const noexcept { return static_cast<Index>(positions_.size()); }
  /// In the order in which they were given.
  [[nodiscard]] const std::vector<Chain>& chains() const noexcept { return chains_; }

  /// One per node; see coordinates() for a flat array.
  [[nodiscard]] const std::vector<Vector3>& positions() const noexcept { return positions_; }
  /// Of one node, from 0 to node_count() − 1.
  [[nodiscard]] const Vector3& position(Index node) const { return positions_[static_cast<std::size_t>(node)]; }
  /// Replaces the positions. Throws Error(invalid_argument) unless there is one per node.
  void set_positions(std::vector<Vector3> positions);
  /// Likewise by a flat array: x, y, z of each node in turn. Cost: one copy.
  void set_positions(std::span<const double> coordinates);

 private:
  std::vector<Vector3> positions_;
  std::vector<Chain> chains_;
};

/// 1 for each node where an open chain begins or ends, else 0; one entry per node. Cost: linear.
[[nodiscard]] std::vector<std::uint8_t> boundary_nodes(const PolygonCurve& curve);

/// Joins segments to chains: maximal runs through nodes of exactly two segments. segments: pairs of nodes, in any order
/// and direction; one from a node to itself is left out. Chains come in the order of their first segments and run in
/// their direction. Cost: linear.
[[nodiscard]] std::vector<PolygonCurve::Chain> chains_of_segments(const std::vector<std::pair<Index, Index>>& segments,
                                                                  Index node_count);

}  // namespace vspring
