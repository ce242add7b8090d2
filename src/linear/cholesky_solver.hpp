#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "base/threads.hpp"
#include "linear/linear_solver.hpp"
#include "linear/sparse_rows.hpp"

namespace vspring {

/// Solves by a sparse factor L D Lᵀ, with columns ordered by approximate minimum degree. Cost for n nodes of a surface:
/// about n^1.5 once, n log n for every column.
class CholeskySolver final : public LinearSolver {
 public:
  explicit CholeskySolver(ThreadTeam& team) : team_(&team) {}

  /// Factorises a matrix; if a pivot vanishes, with a small number added to its diagonal. A matrix with the pattern of
  /// the last one reuses its ordering.
  void build(const SparseRows& matrix) { build(matrix.to_eigen()); }
  /// Factorises a matrix given by its lower triangle and diagonal.
  void build(const Eigen::SparseMatrix<double>& matrix);
  /// The cost of build(), in iterations of the equilibrium solver with all nodes.
  [[nodiscard]] double work_of_building() const;
  void solve(std::span<double> values, const Accuracy& accuracy) override;
  void solve(std::span<Vector3> values, const Accuracy& accuracy) override;

 private:
  /// The solution for one column; NaN if there is no factor.
  [[nodiscard]] Eigen::VectorXd solution(const Eigen::VectorXd& column) const;

  using Matrix = Eigen::SparseMatrix<double>;
  /// Eigen's factor, but cancellation ends the factorisation, which is long for rows with very many entries.
  class Factor : public Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> {
   public:
    void factorize(const Matrix& matrix);
  };

  ThreadTeam* team_;
  Factor factor_;
  std::vector<int> ordered_pattern_;  ///< begins of columns, and rows
};

}  // namespace vspring
