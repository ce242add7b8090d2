#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "base/threads.hpp"
#include "linear/linear_solver.hpp"
#include "linear/sparse_rows.hpp"

namespace vspring {

/// By a sparse factor L D Lᵀ, with columns ordered by approximate minimum degree. Cost for n nodes of a surface: about
/// n^1.5 once, n log n for every column.
class CholeskySolver final : public LinearSolver {
 public:
  explicit CholeskySolver(ThreadTeam& team) : team_(&team) {}

  /// Makes ready for a matrix; where a pivot vanishes for that with a trifle added to its diagonal. One with the
  /// pattern of the last keeps its ordering.
  void build(const SparseRows& matrix) { build(matrix.to_eigen()); }
  /// The same of what is below the diagonal and on it.
  void build(const Eigen::SparseMatrix<double>& matrix);
  /// What that takes, in iterations of the equilibrium solver with all nodes.
  [[nodiscard]] double work_of_building() const;
  void solve(std::span<double> values, const Accuracy& accuracy) override;
  void solve(std::span<Vector3> values, const Accuracy& accuracy) override;

 private:
  /// Not numbers where there is no factor.
  [[nodiscard]] Eigen::VectorXd solution(const Eigen::VectorXd& column) const;

  using Matrix = Eigen::SparseMatrix<double>;
  /// Eigen's, but that factorising ends where it is cancelled: of rows with very many entries that takes long.
  class Factor : public Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> {
   public:
    void factorize(const Matrix& matrix);
  };

  ThreadTeam* team_;
  Factor factor_;
  std::vector<int> ordered_pattern_;  ///< where columns begin, and rows
};

}  // namespace vspring
