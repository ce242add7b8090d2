#pragma once

#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/model.hpp"
#include "vspring/types.hpp"

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

/// Turns forces into the correction that would reach equilibrium if the equations were linear: an approximate inverse
/// of their derivative.
class Preconditioner {
 public:
  Preconditioner() = default;
  virtual ~Preconditioner() = default;
  Preconditioner(const Preconditioner&) = delete;
  Preconditioner& operator=(const Preconditioner&) = delete;

  /// Builds anew if the shape, or the points that pull at it, have changed enough; returns whether it did. Needs
  /// directions.
  virtual bool refresh(const Model& model) = 0;

  /// The cost of building anew, in iterations without it.
  [[nodiscard]] virtual double work_of_building() const = 0;

  /// Finds the correction of every moving node for its force. Needs directions. enough: an error that does not matter.
  virtual void correct(const Model& model, double enough, std::vector<Vector3>& correction) = 0;
};

}  // namespace vspring
