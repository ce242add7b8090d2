#pragma once

#include <span>

#include "vspring/types.hpp"

namespace vspring {

/// Solves systems with one symmetric positive definite matrix, to the accuracy that a preconditioner needs. The same
/// bits for every number of threads.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Puts the solution in the right side's place; of vectors for each coordinate. enough: an error that no value needs
  /// to be freed of.
  virtual void solve(std::span<double> values, double enough) = 0;
  virtual void solve(std::span<Vector3> values, double enough) = 0;
};

}  // namespace vspring
