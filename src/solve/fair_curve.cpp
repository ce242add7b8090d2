// Curves (§4.8).

#include <utility>

#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "checks/result_check.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/curve_hierarchy.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/multigrid_method.hpp"
#include "equilibrium/sweep_method.hpp"
#include "levels/curve_levels.hpp"
#include "vspring/fair.hpp"

namespace vspring {

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  const Stopwatch stopwatch;
  options.validate();
  FairResult result;
  FairReport& report = result.report;
  report.warnings = check_constraints(curve, constraints);
  report.method = options.method.value_or(Method::equilibrium);

  ProgressReporter progress(context);
  progress.report("preparing", 0);
  ThreadTeam team(context.thread_count());
  report.threads = team.size();
  CurveNet gathered = gather_net(curve, constraints);
  count_nodes(gathered.net, constraints, report);
  report.before = measure(curve, &constraints);

  const auto model = curve_model_for(gathered.net, options.curve, options.forces);
  const Distribution distribution = options.distribution.value_or(Distribution::even);
  const ResultCheck check(gathered.net, *model, team);
  const SolverCall call{options, team, context, progress, report};
  if (report.method == Method::sweep) {
    set_laplacian_weights(gathered.net, *model, distribution, team);
    run_sweeps(gathered.net, *model, call);
  } else {
    CurveHierarchy hierarchy(curve_levels(std::move(gathered), distribution));
    if (report.method == Method::multigrid) {
      run_multigrid(hierarchy, *model, call);
    } else {
      run_equilibrium(hierarchy, *model, call, &check);
    }
    gathered = std::move(hierarchy).take();
  }
  if (report.method != Method::equilibrium) warn_if_worse(check, gathered.net, report);

  result.positions = scatter_positions(gathered.net, curve.positions(), constraints, options.strength);
  measure_moves(gathered.net, curve.positions(), result.positions, report);
  PolygonCurve faired = curve;
  faired.set_positions(result.positions);
  report.after = measure(faired, &constraints);
  report.seconds = stopwatch.seconds();
  return result;
}

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(curve, constraints, options, context);
}

}  // namespace vspring
