#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/linear_solver.hpp"
#include "solve/sparse_rows.hpp"

namespace vspring {

/// How coarse spaces hang together: interpolation from each to the next finer one, and back.
struct Interpolation {
  SparseRows up;
  SparseRows down;  ///< its transpose
};

/// By conjugate gradients, preconditioned by a multigrid cycle: Galerkin matrices on all coarse spaces, Chebyshev
/// polynomials of the matrix scaled by its diagonal as smoothers, a sparse factor on the coarsest. Cost for n nodes:
/// linear once, and linear for every column where the number of iterations does not grow.
class MultigridSolver final : public LinearSolver {
 public:
  /// interpolations: the finest first; they must outlive the solver. reduction: of the residual, in the norm that the
  /// preconditioner gives.
  MultigridSolver(std::span<const Interpolation> interpolations, double reduction, ThreadTeam& team);

  void build(SparseRows matrix) override;
  void solve(Eigen::MatrixXd& columns) override;

  /// Of the last solve.
  [[nodiscard]] int iterations() const noexcept { return iterations_; }

 private:
  struct Level {
    SparseRows matrix;
    std::vector<double> inverse_diagonal;
    double greatest = 0;  ///< eigenvalue of the matrix scaled by its diagonal
  };
  template <int columns>
  class Cycle;
  double greatest_eigenvalue(const Level& level) const;
  template <int columns>
  void solve_columns(Eigen::MatrixXd& values);

  std::span<const Interpolation> interpolations_;
  double reduction_;
  ThreadTeam* team_;
  std::vector<Level> levels_;
  std::unique_ptr<CholeskySolver> coarsest_;
  int iterations_ = 0;
};

/// Multigrid, or Cholesky factors where there is no interpolation.
std::unique_ptr<LinearSolver> linear_solver(std::span<const Interpolation> interpolations, double reduction,
                                            ThreadTeam& team);

}  // namespace vspring
