#pragma once

#include <vector>

#include "spring/model.hpp"
#include "vspring/types.hpp"

namespace vspring {

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
