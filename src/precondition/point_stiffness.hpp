#pragma once

#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/model.hpp"

namespace vspring {

/// By how much what the points of a node ask falls as it moves (NodeForce::stiffness), as a preconditioner has built it
/// in.
class PointStiffness {
 public:
  /// Looks at the net as it is now; needs directions. True where that differs so much from what was found before that
  /// it is taken over. Cost: that of the forces; nothing for a net without points.
  bool renew(const Net& net, const Model& model, ThreadTeam& team);

  /// For every moving node; empty where there are no points.
  [[nodiscard]] std::span<const double> values() const { return values_; }

 private:
  std::vector<double> values_;
  std::vector<double> now_;
};

}  // namespace vspring
