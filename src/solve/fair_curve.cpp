// Curves (§4.8).

#include <memory>
#include <utility>

#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "checks/result_check.hpp"
#include "constraints/holding.hpp"
#include "constraints/sides.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/from_options.hpp"
#include "solve/papers_method.hpp"
#include "spring/curve_net.hpp"
#include "vspring/fair.hpp"

namespace vspring {

namespace {

FairResult fair_sides(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                      Context& context) {
  const Stopwatch stopwatch;
  options.validate();
  FairResult result;
  FairReport& report = result.report;
  report.warnings = check_sides(curve, constraints);
  report.method = options.method_kind();

  ProgressReporter progress(context);
  progress.report("preparing", 0);
  ThreadTeam team(context.thread_count());
  report.threads = team.size();
  Net net = gather_net(curve, constraints);
  count_nodes(net.moving, constraints, report);

  const auto model = model_of(net, options);
  const ResultCheck check(net, *model, team);
  const SolverCall call{team, context, progress, report};
  if (report.method == Method::equilibrium) {
    const Distribution distribution = distribution_of(net, options);
    const std::unique_ptr<Hierarchy> hierarchy = hierarchy_of(std::move(net), *model, distribution, team);
    run_equilibrium(*hierarchy, *model, search_task(options), call, &check);
    net = std::move(*hierarchy).take();
  } else {
    net = run_papers_method(std::move(net), *model, check, options, call);
  }

  result.positions = scatter_positions(net, curve.positions(), constraints, options.strength);
  measure_moves(net, curve.positions(), result.positions, report);
  report.seconds = stopwatch.seconds();
  return result;
}

}  // namespace

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  check_corners(curve, constraints);
  if (options.corners.empty() && constraints.corner_count() == 0)
    return fair_sides(curve, constraints, options, context);
  // Each side of a corner as a chain of its own.
  const Sides sides = cut_into_sides(curve, constraints, options.corners);
  FairResult result = fair_sides(sides.curve, sides.held, options, context);
  result.report.corners = sides.corners;
  return result;
}

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(curve, constraints, options, context);
}

}  // namespace vspring
