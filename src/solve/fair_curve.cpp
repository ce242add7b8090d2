// Curves (§4.8).

#include <chrono>
#include <cmath>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "levels/curve_levels.hpp"
#include "shape/planarity.hpp"
#include "solve/account.hpp"
#include "solve/curve_preconditioner.hpp"
#include "solve/equilibrium.hpp"
#include "solve/sweep_method.hpp"
#include "vspring/fair.hpp"

namespace vspring {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Whether everything lies in one plane, given directions too, so that normals in the plane are all there is.
bool is_planar(const Net& net) {
  const auto normal = plane_normal(net.positions);
  if (!normal) return false;
  for (std::size_t i = 0; i < net.node.size(); ++i) {
    if (net.tangent_given(i) && std::abs(net.tangents[i].dot(*normal)) > 1e-9) return false;
    if (net.normal_given(i) && std::abs(net.normals[i].dot(*normal)) > 1e-9) return false;
  }
  return true;
}

double diagonal(const Net& net) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : net.positions) box.extend(position);
  return box.isEmpty() ? 1 : box.diagonal().norm();
}

/// Coarse levels first, each to its equilibrium, each the start of the next finer one.
void run_equilibrium(CurveNet& curve, const Model& model, const FairOptions& options, ThreadTeam& team,
                     Context& context, ProgressReporter& progress, FairReport& report) {
  const double size = diagonal(curve.net);
  auto levels = curve_levels(std::move(curve), options.distribution);
  const auto finest_nodes = static_cast<double>(levels.back().curve.net.moving);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const auto begin = Clock::now();
    CurveLevel& level = levels[k];
    const bool finest = k + 1 == levels.size();
    CurvePreconditioner preconditioner(level.curve);
    EquilibriumTask task;
    // What a coarse level leaves undone, the finer ones have to do with more nodes.
    task.tolerance = options.tolerance * size * (finest ? 1 : 0.3);
    task.max_iterations = options.max_iterations.value_or(task.max_iterations);
    const double share = static_cast<double>(level.curve.net.moving) / finest_nodes;
    task.on_iteration = [&](double expected) {
      report.history.push_back(expected / size);
      progress.report("fairing", share / 2, static_cast<int>(report.history.size()), expected / size);
    };
    const EquilibriumResult result = go_to_equilibrium(level.curve.net, model, preconditioner, task, team, context);
    report.iterations += result.iterations;
    report.levels.push_back({.moving_nodes = static_cast<Index>(level.curve.net.moving),
                             .iterations = result.iterations,
                             .seconds = seconds_since(begin)});
    if (finest) {
      report.outcome = result.outcome;
      report.residual = result.expected_error / size;
      report.expected_error = report.residual;
    } else {
      update_directions(level.curve.net, model, team);
      prolong(level, levels[k + 1]);
    }
  }
  curve = std::move(levels.back().curve);
}

}  // namespace

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  const auto begin = Clock::now();
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

  CurveRules rules = options.curve;
  if (is_planar(gathered.net)) rules.normal_plane = NormalPlane::full;
  const auto model = curve_model(rules);
  if (report.method == Method::equilibrium) {
    run_equilibrium(gathered, *model, options, team, context, progress, report);
  } else {
    distribute(gathered.net, *model, options.distribution, team);
    run_sweeps(gathered.net, *model, options, team, context, progress, report);
  }

  result.positions = scatter_positions(gathered.net, curve.positions(), constraints, options.strength);
  measure_moves(gathered.net, curve.positions(), result.positions, report);
  PolygonCurve faired = curve;
  faired.set_positions(result.positions);
  report.after = measure(faired, &constraints);
  report.seconds = seconds_since(begin);
  return result;
}

FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(curve, constraints, options, context);
}

}  // namespace vspring
