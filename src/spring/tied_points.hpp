#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Scattered points, each tied to one node of a net (§4.5), in the coordinates of the net.
struct TiedPoints {
  std::vector<Vector3> positions;
  std::vector<double> weights;         ///< k_j of Eq. 9
  std::vector<Vector3> normals;        ///< of the surface there, unit or zero; empty: unknown
  std::vector<std::uint32_t> numbers;  ///< per point its number among the given ones; clusters have none
  std::vector<std::uint32_t> order;    ///< the points, node by node of the net
  std::vector<std::uint32_t> begin;    ///< where each node's points begin in that order, and their number at the end
  std::vector<std::uint32_t> end;      ///< where the points that pull at the node end; empty: all pull
  bool are_nodes = false;              ///< whether each is the place of a node in the input, to which it stays tied
  std::vector<double> factors;         ///< per node the factor of the average of its k_j; empty: 1

  [[nodiscard]] bool empty() const noexcept { return order.empty(); }
  /// The points that pull at a node.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t node) const noexcept {
    return {order.data() + begin[node], (end.empty() ? begin[node + 1] : end[node]) - begin[node]};
  }
  /// All points of a node, also those that it faces away from, which do not pull.
  [[nodiscard]] std::span<const std::uint32_t> all_of(std::size_t node) const noexcept {
    return {order.data() + begin[node], begin[node + 1] - begin[node]};
  }
  [[nodiscard]] double factor(std::size_t node) const noexcept { return factors.empty() ? 1 : factors[node]; }
};

}  // namespace vspring
