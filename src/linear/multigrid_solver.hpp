#pragma once

#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/cholesky_solver.hpp"
#include "linear/interpolation.hpp"
#include "linear/level_matrix.hpp"
#include "linear/linear_solver.hpp"

namespace vspring {

/// Solves by conjugate gradients, preconditioned by a multigrid cycle. Every level has a matrix of its own and is
/// smoothed by Chebyshev polynomials of it, scaled by its diagonal; a sparse factor solves on the coarsest. Cost for n
/// nodes: linear once, and linear for every column as long as the number of iterations does not grow.
class MultigridSolver final : public LinearSolver {
 public:
  /// interpolations: the finest first; they must outlive the solver.
  MultigridSolver(std::span<const Interpolation> interpolations, ThreadTeam& team);

  /// Builds from the matrix of the finest level; coarser ones get Galerkin's. On coarse nets, which are irregular,
  /// forms of their own would differ too much from that of the finest.
  void build(LevelMatrix finest);
  /// Replaces the finest matrix; keeps those of coarser levels.
  void replace_finest(LevelMatrix matrix);

  void solve(std::span<double> values, const Accuracy& accuracy) override;
  void solve(std::span<Vector3> values, const Accuracy& accuracy) override;
  /// Solves by one cycle.
  bool solve_coarser(std::span<Vector3> values) override;

 private:
  struct Level {
    LevelMatrix matrix;
    std::vector<float> inverse_diagonal = {};
    double greatest = 0;            ///< eigenvalue of the matrix scaled by its diagonal
    std::vector<float> rough = {};  ///< nearly its eigenvector
  };
  /// Buffers of a solve, shared, as two solvers never work at the same time.
  template <typename Value>
  class Cycle;
  void add_level(LevelMatrix matrix);
  void scale(Level& level) const;
  template <typename Value, typename Values>
  void solve_any(Cycle<Value>& cycle, Values values, const Accuracy& accuracy);

  std::span<const Interpolation> interpolations_;
  ThreadTeam* team_;
  std::vector<Level> levels_;
  CholeskySolver coarsest_;
};

}  // namespace vspring
