#pragma once

#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/joined_ends.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Applies --closed to the chains of a curve, see JoinedEnds.
class ClosedChains {
 public:
  /// closed: whether --closed is given; if not, chains do not change.
  ClosedChains(PolygonCurve& curve, bool closed);
  /// Surfaces have no chains.
  ClosedChains(const PolygonMesh& /*mesh*/, bool /*closed*/) {}

  void hold(Constraints& constraints) const { ends_.hold(constraints); }
  void follow(std::vector<Vector3>& positions) const { ends_.follow(positions); }
  /// A line for people about chains that stay open though they end exactly where they begin; empty if there are none.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  JoinedEnds ends_;
  std::string note_;
};

}  // namespace vspring::cli
