#include "equilibrium/sweep_method.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancellation.hpp"
#include "equilibrium/best_iterate.hpp"
#include "sweep/sweep.hpp"

namespace vspring {

namespace {

// Steps may well grow for a while, when a fold opens or a bulge turns over; beyond this they tell of a shape that falls
// apart: under too few constraints nodes can go on drifting to one side of a closed surface until it collapses.
constexpr double lost_factor = 10;
constexpr int sweep_patience = 500;
constexpr int sweeps_per_tie = 5;
// Where a point changes over to another node, steps as small as this may jump, and nothing is lost.
constexpr double small_step = 1e-3;

/// Steps fall about geometrically, so the logarithm of the step tells how much of the way is done.
double share_done(double first, double now, double last) {
  if (now <= last) return 1;
  return first > now ? std::log(first / now) / std::log(first / last) : 0;
}

}  // namespace

SweepResult sweep_until_still(Net& net, const Model& model, const SweepTask& task, ThreadTeam& team, Context& context) {
  Sweep sweep(net, model, team, task.order);
  BestIterate best(net, lost_factor, task.renew_ties ? small_step : 0);
  SweepResult result;
  bool at_rest = false;
  while (result.outcome == Outcome::iteration_limit && result.iterations < task.max_iterations) {
    if (context.cancelled()) {
      result.outcome = Outcome::cancelled;
      break;
    }
    const bool fresh = !task.renew_ties || at_rest || result.iterations % sweeps_per_tie == 0;
    try {
      const CancellationScope cancellation(context);
      if (task.renew_ties && fresh) task.renew_ties();
      result.residual = sweep.iterate();
    } catch (const Cancelled&) {
      // Nodes that the sweep has not reached stay, as in any unfinished shape.
      result.outcome = Outcome::cancelled;
      break;
    }
    ++result.iterations;
    best.look(result.residual);
    if (task.on_iteration) task.on_iteration(result.residual);
    at_rest = result.residual < task.step_tolerance;
    if (at_rest && fresh) {
      result.outcome = Outcome::converged;
    } else if ((best.lost_for() >= sweep_patience && !task.keep_last) || !std::isfinite(result.residual)) {
      result.outcome = Outcome::stalled;
    }
  }
  const bool is_finite = std::isfinite(result.residual);
  result.lost = best.lost_for() > 0 && (task.step_tolerance > 0 || result.outcome == Outcome::stalled) &&
                !(task.keep_last && is_finite);
  if (result.lost) result.residual = best.restore();
  return result;
}

void warn_of_growing_steps(FairReport& report) {
  report.warnings.push_back(
      {WarningCode::steps_grew,
       "the steps grew again, so the shape has no equilibrium that the iteration can reach: the shape with the "
       "smallest steps is kept",
       {{Remedy::rules, "hold more nodes, or normals"}, {Remedy::region, "let a smaller region move"}}});
}

void run_sweeps(Net& net, const Model& model, const SweepMethod& method, const SolverCall& call,
                std::function<void()> renew_ties) {
  FairReport& report = call.report;
  SweepTask task{.step_tolerance = method.step_tolerance,
                 .max_iterations = method.max_iterations,
                 .order = method.order,
                 .keep_last = method.keep_last,
                 .renew_ties = std::move(renew_ties)};
  task.on_iteration = [&](double residual) {
    report.history.push_back(residual);
    const auto iterations = static_cast<int>(report.history.size());
    call.progress.report("fairing",
                         std::max(share_done(report.history.front(), residual, task.step_tolerance),
                                  static_cast<double>(iterations) / task.max_iterations),
                         iterations, residual);
  };
  const SweepResult result = sweep_until_still(net, model, task, call.team, call.context);
  report.outcome = result.outcome;
  report.iterations = result.iterations;
  report.work += work_of_sweep * static_cast<double>(result.iterations) * static_cast<double>(net.moving);
  report.residual = result.residual;
  if (result.lost) warn_of_growing_steps(report);
}

}  // namespace vspring
