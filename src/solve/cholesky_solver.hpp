#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "base/threads.hpp"
#include "solve/linear_solver.hpp"

namespace vspring {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// By a sparse factor L D Lᵀ, with columns ordered by approximate minimum degree. Cost for n nodes of a surface: about
/// n^1.5 once, n log n for every column.
class CholeskySolver final : public LinearSolver {
 public:
  explicit CholeskySolver(ThreadTeam& team) : team_(&team) {}

  /// Only the lower triangle is looked at. A matrix with the pattern of the last one keeps its ordering.
  void factorise(const SparseMatrix& matrix);
  void solve(Eigen::MatrixXd& columns) override;

 private:
  ThreadTeam* team_;
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
  Eigen::Index ordered_entries_ = -1;
};

}  // namespace vspring
