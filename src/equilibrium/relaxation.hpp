#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "equilibrium/equilibrium.hpp"
#include "equilibrium/hierarchy.hpp"
#include "equilibrium/point_levels.hpp"
#include "equilibrium/solver_call.hpp"
#include "precondition/anderson.hpp"
#include "spring/model.hpp"

namespace vspring {

/// Figures by which equilibria of one surface are compared: some are folds, bent more sharply than their level can
/// show.
struct SpringEnergy {
  /// Σ ((t_j − t_i)/ℓ)² (Eq. 4) over the edges of moving nodes, and those between held neighbours of moving nodes,
  /// whose springs change with these.
  double sum = 0;
  double least_cosine = 1;  ///< of the angle between normals at the edges of moving nodes
};

/// Takes single levels of a hierarchy towards their equilibrium, and accounts for it in the report: outcome,
/// iterations, work, levels, residual, expected error and history.
class Relaxation {
 public:
  /// points: of the levels, if any. Sets the most work of the report.
  Relaxation(Hierarchy& hierarchy, const Model& model, const EquilibriumMethod& method, const SolverCall& call,
             PointLevels* points);

  /// Iterates from the present shape by corrections (go_to_equilibrium()).
  void relax(std::size_t level, int max_iterations) { relax(level, max_iterations, hierarchy_.preconditioner(level)); }
  void relax(std::size_t level, int max_iterations, Preconditioner& preconditioner);
  /// Iterates the shape itself, a surface with springs for least bending, by descend_bending(). home: as in
  /// EquilibriumTask; smoothing_length: of it, as a share of the size.
  void bend_less(int max_iterations, std::span<const Vector3> home, double smoothing_length);
  /// Takes the shape itself to the equilibrium nearby (go_by_newton()).
  void relax_by_newton(int max_iterations);
  /// Takes the shape itself, a curve, to where it is bent least near a home (smooth_near()). smoothing_length: as a
  /// share of the size.
  void smooth_near(const std::vector<Vector3>& home, double smoothing_length);

  /// Sets EquilibriumTask::memory and take_last for all later calls.
  void remember(Anderson<float>* memory, bool take_last) {
    memory_ = memory;
    take_last_ = take_last;
  }
  /// Reports that the result is being checked.
  void report_check() { call_.progress.report("checking", 0.5); }
  /// The strategy that levels in the report have.
  void set_strategy(const char* name) { strategy_ = name; }

  /// A shape, and what is known of it.
  struct Reached {
    std::vector<Vector3> positions;
    Outcome outcome;
    double residual;
  };
  Reached reached(std::size_t level) {
    return {hierarchy_.net(level).positions, call_.report.outcome, call_.report.residual};
  }
  void go_back(std::size_t level, const Reached& reached);
  void tie_points(std::size_t level) {
    if (points_) points_->tie(level);
  }

  /// Updates directions.
  SpringEnergy energy_of(Net& net);
  /// Whether a small level of a surface is folded: coarse levels may fold a shape needlessly.
  bool has_crease(std::size_t level);
  /// Whether the shape that was reached is too far from an equilibrium to be of use.
  [[nodiscard]] bool lost() const;
  /// Whether no equilibrium was reached, and the run is not cancelled.
  [[nodiscard]] bool unfinished() const;
  /// Whether another iteration on that net would be too much.
  [[nodiscard]] bool out_of_work(const Net& net) const;

  [[nodiscard]] std::size_t last() const { return hierarchy_.count() - 1; }
  Net& shape() { return hierarchy_.net(last()); }
  /// The diagonal of the box around the shape at the start, in its coordinates.
  [[nodiscard]] double size() const { return size_; }

 protected:
  Hierarchy& hierarchy_;
  const Model& model_;
  PointLevels* points_;
  SolverCall call_;

 private:
  void relax(std::size_t level, int max_iterations,
             const std::function<EquilibriumResult(const EquilibriumTask&)>& method);

  EquilibriumMethod method_;
  double size_;
  Anderson<float>* memory_ = nullptr;
  bool take_last_ = false;
  const char* strategy_ = "";
};

}  // namespace vspring
