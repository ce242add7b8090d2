#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"

namespace VSPRING_API vspring {

/// Ends of chains that are joined, also where a table repeats the first row of a ring at its end.
class JoinedEnds {
 public:
  /// Of no chain.
  JoinedEnds() = default;
  /// Closes open chains of a curve of two nodes or more. A last node exactly at the place of the first is left out of
  /// its chain, and follows the first. closes: 1 for each chain to be closed; empty: all. Throws
  /// Error(invalid_argument) unless there is one per chain. Cost: linear.
  explicit JoinedEnds(PolygonCurve& curve, std::span<const std::uint8_t> closes = {});

  /// Applies the constraints of nodes that follow others to these. Throws Error(unusable_constraint) naming both if
  /// they are held at different places.
  void hold(Constraints& constraints) const;
  /// Moves nodes that follow others to these. positions: one per node.
  void follow(std::vector<Vector3>& positions) const;
  /// Nodes that follow others, each with that one.
  [[nodiscard]] const std::vector<std::pair<Index, Index>>& followers() const noexcept { return followers_; }

 private:
  std::vector<std::pair<Index, Index>> followers_;
};

}  // namespace vspring
