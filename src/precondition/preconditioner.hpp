#pragma once

#include <vector>

#include "spring/model.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Turns displacements that the model asks for into the correction that would bring about equilibrium if the equations
/// were linear: an approximate inverse of their derivative.
class Preconditioner {
 public:
  Preconditioner() = default;
  virtual ~Preconditioner() = default;
  Preconditioner(const Preconditioner&) = delete;
  Preconditioner& operator=(const Preconditioner&) = delete;

  /// Looks at the shape, and the points that pull at it, as they are now. True where that has changed so much that all
  /// was built anew. Needs directions.
  virtual bool refresh(const Model& model) = 0;

  /// What building anew costs, in iterations without.
  [[nodiscard]] virtual double work_of_building() const = 0;

  /// The correction of every moving node for the forces that the model puts on them. Needs directions. enough: an error
  /// of it that does not matter.
  virtual void correct(const Model& model, double enough, std::vector<Vector3>& correction) = 0;
};

}  // namespace vspring
