// Curves (§4.8).

#include <algorithm>
#include <memory>
#include <utility>

#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "checks/result_check.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/from_options.hpp"
#include "shape/corners.hpp"
#include "solve/papers_method.hpp"
#include "spring/curve_net.hpp"
#include "vspring/fair.hpp"

namespace vspring {

namespace {

/// Each side of a corner as a chain of its own.
FairResult fair_sides(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                      Context& context) {
  if (constraints.node_count() != curve.node_count()) (void)check_constraints(curve, constraints);
  Constraints held = constraints;
  std::vector<std::uint8_t> corners = marked_corners(options.corners, curve.node_count());
  for (const Index node : options.corners) {
    if (held.tangent_fixed(node) || held.normal_fixed(node))
      corners[static_cast<std::size_t>(node)] = 0;
    else if (!held.position_fixed(node))
      held.fix_position(node, curve.position(node));
  }
  FairOptions of_sides = options;
  of_sides.corners.clear();
  FairResult result = fair(cut_at_corners(curve, corners), held, of_sides, context);
  result.report.corners = static_cast<Index>(std::count(corners.begin(), corners.end(), 1));
  return result;
}

}  // namespace

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  if (!options.corners.empty()) return fair_sides(curve, constraints, options, context);
  const Stopwatch stopwatch;
  options.validate();
  FairResult result;
  FairReport& report = result.report;
  report.warnings = check_constraints(curve, constraints);
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

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(curve, constraints, options, context);
}

}  // namespace vspring
