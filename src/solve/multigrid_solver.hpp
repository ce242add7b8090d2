#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/interpolation.hpp"
#include "solve/linear_solver.hpp"
#include "solve/sparse_rows.hpp"

namespace vspring {

/// A symmetric matrix, in one of three forms: `whole`; `columns` times `rows`, its transpose; or `rows` alone. A
/// product that is not multiplied out stays positive and exact for what its rows take to zero, in single precision too.
struct LevelMatrix {
  SparseRows whole;
  FloatRows rows;
  FloatRows columns;
  /// The form of a smooth function, the same one on every level, per area: what matrices of different levels are
  /// compared by.
  double unit = 1;

  [[nodiscard]] std::size_t size() const noexcept { return whole.empty() ? rows.columns() : whole.columns(); }
};

/// By conjugate gradients, preconditioned by a multigrid cycle: every level has a matrix of its own, Chebyshev
/// polynomials of it scaled by its diagonal smooth, a sparse factor solves on the coarsest. Cost for n nodes: linear
/// once, and linear for every column where the number of iterations does not grow.
class MultigridSolver final : public LinearSolver {
 public:
  /// interpolations: the finest first; they must outlive the solver. reduction: of the greatest error
  /// of a value, as far as a cycle can tell it.
  MultigridSolver(std::span<const Interpolation> interpolations, double reduction, ThreadTeam& team);

  /// matrices: of all levels but the coarsest, the finest first.
  void build(std::vector<LevelMatrix> matrices, const SparseRows& coarsest, double coarsest_unit);
  /// Keeps those of the coarser levels.
  void replace_finest(LevelMatrix matrix);

  void solve(std::span<double> values, double enough) override { solve_any(values, enough); }
  void solve(std::span<Vector3> values, double enough) override { solve_any(values, enough); }

  /// Of the last solve.
  [[nodiscard]] int iterations() const noexcept { return iterations_; }

 private:
  struct Level {
    LevelMatrix matrix;
    std::vector<float> inverse_diagonal;
    double greatest = 0;       ///< eigenvalue of the matrix scaled by its diagonal
    std::vector<float> rough;  ///< nearly the vector that belongs to it
  };
  template <typename Value>
  class Cycle;
  void set_level(Level& level, LevelMatrix matrix) const;
  template <typename Values>
  void solve_any(Values values, double enough);

  std::span<const Interpolation> interpolations_;
  double reduction_;
  ThreadTeam* team_;
  std::vector<Level> levels_;
  CholeskySolver coarsest_;
  double coarsest_unit_ = 1;
  int iterations_ = 0;
};

}  // namespace vspring
