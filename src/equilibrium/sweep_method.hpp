#pragma once

#include <functional>

#include "base/threads.hpp"
#include "equilibrium/solver_call.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// When plain iterations over one net end.
struct SweepTask {
  double step_tolerance = 1e-3;  ///< e of §4.6; 0 for as many iterations as there may be
  int max_iterations = 10000;
  SweepOrder order = SweepOrder::parallel;
  bool keep_last = false;  ///< as in SweepMethod
  /// Called after every iteration with its largest displacement relative to the mean edge length.
  std::function<void(double)> on_iteration = nullptr;
  /// Ties scattered points to the nodes that are nearest by now (§4.5), before every few iterations and before the
  /// last.
  std::function<void()> renew_ties = nullptr;
};

/// What a sweep of a node costs, in iterations of the equilibrium solver.
inline constexpr double work_of_sweep = 1.0 / 16;

struct SweepResult {
  Outcome outcome = Outcome::iteration_limit;
  int iterations = 0;
  double residual = 0;
  /// Whether the shape is an earlier one, that with the smallest steps, as these grew again.
  bool lost = false;
};

/// The paper's plain iteration (Fig. 3) until the termination condition of §4.6 holds.
SweepResult sweep_until_still(Net& net, const Model& model, const SweepTask& task, ThreadTeam& team, Context& context);

/// Warns that the steps grew again.
void warn_of_growing_steps(FairReport& report);

/// The plain iteration on the shape itself. Fills outcome, iterations, residual and history. renew_ties: as in
/// SweepTask.
void run_sweeps(Net& net, const Model& model, const SweepMethod& method, const SolverCall& call,
                std::function<void()> renew_ties = nullptr);

}  // namespace vspring
