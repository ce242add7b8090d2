#pragma once

#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// What --closed makes of the chains of a curve: the last node of every open chain joins the first. A last node at the
/// very place of the first is left out, and follows it.
class ClosedChains {
 public:
  /// closed: whether --closed is given; else chains stay as they are.
  ClosedChains(PolygonCurve& curve, bool closed);
  /// Surfaces have no chains.
  ClosedChains(const PolygonMesh& /*mesh*/, bool /*closed*/) {}

  /// What is said of a node that repeats another one holds that one. Throws Error(unusable_constraint) where they are
  /// held at different places.
  void hold(Constraints& constraints) const;
  /// Takes the nodes that repeat others to where those are.
  void follow(std::vector<Vector3>& positions) const;
  /// What a person should know of chains that stay open and end at the very place where they begin, a line; empty
  /// without.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  /// A node that repeats the position of another one and goes where that goes.
  struct DuplicateEnd {
    Index node;
    Index of;
  };

  std::vector<DuplicateEnd> repeats_;
  std::string note_;
};

}  // namespace vspring::cli
