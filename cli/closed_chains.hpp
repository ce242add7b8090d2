#pragma once

#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Applies --closed to the chains of a curve: the last node of every open chain joins the first. A last node exactly at
/// the first is left out of the chain and follows the first.
class ClosedChains {
 public:
  /// closed: whether --closed is given; if not, chains do not change.
  ClosedChains(PolygonCurve& curve, bool closed);
  /// Surfaces have no chains.
  ClosedChains(const PolygonMesh& /*mesh*/, bool /*closed*/) {}

  /// Applies the constraints of a node that repeats another one to that one. Throws Error(unusable_constraint) if they
  /// are held at different places.
  void hold(Constraints& constraints) const;
  /// Moves nodes that repeat others to these.
  void follow(std::vector<Vector3>& positions) const;
  /// A line for people about chains that stay open though they end exactly where they begin; empty if there are none.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  /// A node that repeats the position of another one and follows it.
  struct DuplicateEnd {
    Index node;
    Index of;
  };

  std::vector<DuplicateEnd> repeats_;
  std::string note_;
};

}  // namespace vspring::cli
