#pragma once

#include <span>

#include "vspring/types.hpp"

namespace vspring {

/// When an iterating solver may end: the next cycle would change no value by more than `enough`, or by more than
/// `share` of the first cycle's change. With a share of 1 there is one cycle.
struct Accuracy {
  double enough = 0;
  double share = 0;
};

/// Solves systems with one symmetric positive definite matrix, to the accuracy that a preconditioner needs. The same
/// bits for every number of threads.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Replaces the right side by the solution; vectors by coordinates.
  virtual void solve(std::span<double> values, const Accuracy& accuracy) = 0;
  virtual void solve(std::span<Vector3> values, const Accuracy& accuracy) = 0;
  /// Solves approximately, with the matrix of the next coarser level. Returns false and does nothing if there is none.
  virtual bool solve_coarser(std::span<Vector3> /*values*/) { return false; }
};

}  // namespace vspring
