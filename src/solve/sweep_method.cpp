#include "solve/sweep_method.hpp"

#include <cmath>

#include "solve/best_shape.hpp"
#include "sweep/sweep.hpp"

namespace vspring {

namespace {

// Steps may well grow for a while, when a fold opens or a bulge turns over; beyond this they tell of a shape that falls
// apart: under too few constraints nodes can go on drifting to one side of a closed surface until it collapses.
constexpr double lost_factor = 10;
constexpr int patience = 500;

constexpr int default_limit = 10000;

/// Steps fall about geometrically, so the logarithm of the step tells how much of the way is done.
double share_done(double first, double now, double last) {
  if (now <= last) return 1;
  return first > now ? std::log(first / now) / std::log(first / last) : 0;
}

}  // namespace

void run_sweeps(Net& net, const Model& model, const FairOptions& options, ThreadTeam& team, Context& context,
                ProgressReporter& progress, FairReport& report) {
  Sweep sweep(net, model, team);
  BestShape best(net, lost_factor);
  report.outcome = Outcome::iteration_limit;
  const int limit = options.max_iterations.value_or(default_limit);
  while (report.outcome == Outcome::iteration_limit && report.iterations < limit) {
    if (context.cancelled()) {
      report.outcome = Outcome::cancelled;
      break;
    }
    report.residual = sweep.iterate();
    ++report.iterations;
    report.history.push_back(report.residual);
    best.look(report.residual);
    progress.report("fairing",
                    std::max(share_done(report.history.front(), report.residual, options.step_tolerance),
                             static_cast<double>(report.iterations) / limit),
                    report.iterations, report.residual);
    if (report.residual < options.step_tolerance) {
      report.outcome = Outcome::converged;
    } else if (best.lost_for() >= patience) {
      report.outcome = Outcome::stalled;
    }
  }
  if (best.lost_for() > 0) {
    report.residual = best.restore();
    report.warnings.emplace_back(
        "the steps grew again, so the shape has no equilibrium that the iteration can reach: the one with the smallest "
        "steps is kept; hold more nodes, or normals, or let a smaller region move");
  }
}

}  // namespace vspring
