#pragma once

#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/model.hpp"

namespace vspring {

/// The stiffness of points (NodeForce::stiffness) that a preconditioner was built with.
class PointStiffness {
 public:
  /// Updates the values from the net if they differ enough, and returns whether it did. Needs directions. Cost: that of
  /// the forces; nothing for a net without points.
  bool renew(const Net& net, const Model& model, ThreadTeam& team);

  /// One value for every moving node; empty without points.
  [[nodiscard]] std::span<const double> values() const { return values_; }

 private:
  std::vector<double> values_;
  std::vector<double> now_;
};

}  // namespace vspring
