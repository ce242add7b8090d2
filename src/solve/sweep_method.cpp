#include "solve/sweep_method.hpp"

#include <cmath>

#include "sweep/sweep.hpp"

namespace vspring {

namespace {

/// Steps fall about geometrically, so the logarithm of the step tells how much of the way is done.
double share_done(double first, double now, double last) {
  if (now <= last) return 1;
  return first > now ? std::log(first / now) / std::log(first / last) : 0;
}

}  // namespace

void run_sweeps(Net& net, const FairOptions& options, ThreadTeam& team, Context& context, ProgressReporter& progress,
                FairReport& report) {
  Sweep sweep(net, options.pseudo_normals, options.distribution, team);
  report.outcome = Outcome::iteration_limit;
  while (report.iterations < options.max_iterations) {
    if (context.cancelled()) {
      report.outcome = Outcome::cancelled;
      return;
    }
    report.residual = sweep.iterate();
    ++report.iterations;
    report.history.push_back(report.residual);
    progress.report("fairing",
                    std::max(share_done(report.history.front(), report.residual, options.step_tolerance),
                             static_cast<double>(report.iterations) / options.max_iterations),
                    report.iterations, report.residual);
    if (report.residual < options.step_tolerance) {
      report.outcome = Outcome::converged;
      return;
    }
  }
}

}  // namespace vspring
