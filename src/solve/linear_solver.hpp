#pragma once

#include <Eigen/Core>

#include "solve/sparse_rows.hpp"

namespace vspring {

/// Solves systems with one symmetric positive definite matrix, to the accuracy that a preconditioner needs.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Makes ready for a matrix.
  virtual void build(SparseRows matrix) = 0;

  /// Puts the solution for every column in its place. The same bits for every number of threads.
  virtual void solve(Eigen::MatrixXd& columns) = 0;
};

}  // namespace vspring
