#pragma once

#include <span>

#include "vspring/types.hpp"

namespace vspring {

/// When a solver that iterates may end: when the next cycle would change no value by more than `enough`, or by more
/// than this share of what the first one changed. With a share of 1 there is one cycle.
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

  /// Puts the solution in the right side's place; of vectors for each coordinate.
  virtual void solve(std::span<double> values, const Accuracy& accuracy) = 0;
  virtual void solve(std::span<Vector3> values, const Accuracy& accuracy) = 0;
  /// The same, roughly, with the matrix of the next coarser level. False, and nothing is done, where there is none.
  virtual bool solve_coarser(std::span<Vector3> /*values*/) { return false; }
};

}  // namespace vspring
