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

/// Whether everything lies in one plane, so that normals in the plane are all there is. Given directions count as far
/// as nodes do: a straight start lies in the plane of its end tangents.
bool is_planar(const Net& net) {
  std::vector<Vector3> points = net.positions;
  for (std::size_t i = 0; i < net.node.size(); ++i) {
    if (net.tangent_given(i)) points.emplace_back(net.positions[i] + net.tangents[i]);
    if (net.normal_given(i)) points.emplace_back(net.positions[i] + net.normals[i]);
  }
  return plane_normal(points).has_value();
}

double diagonal(const Net& net) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : net.positions) box.extend(position);
  return box.isEmpty() ? 1 : box.diagonal().norm();
}

class EquilibriumRun {
 public:
  EquilibriumRun(const Model& model, const FairOptions& options, double size, ThreadTeam& team, Context& context,
                 ProgressReporter& progress, FairReport& report)
      : model_(model),
        options_(options),
        size_(size),
        team_(team),
        context_(context),
        progress_(progress),
        report_(report) {}

  /// Coarse levels first, each to its equilibrium, each the start of the next finer one; none of them where the curve
  /// is at its equilibrium already.
  void run(CurveNet& curve) {
    auto levels = curve_levels(std::move(curve), options_.distribution);
    CurveLevel& finest = levels.back();
    const std::vector<Vector3> start = finest.curve.net.positions;
    if (options_.max_iterations.value_or(1) > 0 && relax(finest, true, 1, 1) != Outcome::converged && levels.size() > 1)
      finest.curve.net.positions = start;
    if (report_.outcome == Outcome::iteration_limit) go_down(levels);
    curve = std::move(finest.curve);
  }

 private:
  void go_down(std::vector<CurveLevel>& levels) {
    const int limit = options_.max_iterations.value_or(default_limit);
    const auto finest_nodes = static_cast<double>(levels.back().curve.net.moving);
    untangle(levels.front());
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const bool finest = k + 1 == levels.size();
      const double share = static_cast<double>(levels[k].curve.net.moving) / finest_nodes;
      (void)relax(levels[k], finest, k == 0 ? std::min(limit, first_try) : limit, share);
      if (k == 0 && limit > first_try && unfinished()) {
        if (report_.residual > lost_at) straighten(levels[k]);
        (void)relax(levels[k], finest, limit, share);
      }
      if (finest) break;
      update_directions(levels[k].curve.net, model_, team_);
      prolong(levels[k], levels[k + 1]);
    }
  }

  [[nodiscard]] bool unfinished() const {
    return report_.outcome == Outcome::iteration_limit || report_.outcome == Outcome::stalled;
  }

  Outcome relax(CurveLevel& level, bool finest, int max_iterations, double share) {
    const auto begin = Clock::now();
    CurvePreconditioner preconditioner(level.curve);
    EquilibriumTask task;
    // What a coarse level leaves undone, the finer ones have to do with more nodes.
    task.tolerance = options_.tolerance * size_ * (finest ? 1 : 0.3);
    task.max_iterations = max_iterations;
    task.on_iteration = [&](double expected) {
      report_.history.push_back(expected / size_);
      progress_.report("fairing", share / 2, static_cast<int>(report_.history.size()), expected / size_);
    };
    const EquilibriumResult result = go_to_equilibrium(level.curve.net, model_, preconditioner, task, team_, context_);
    report_.iterations += result.iterations;
    report_.levels.push_back({.moving_nodes = static_cast<Index>(level.curve.net.moving),
                              .iterations = result.iterations,
                              .seconds = seconds_since(begin)});
    report_.outcome = result.outcome;
    report_.residual = result.expected_error / size_;
    report_.expected_error = report_.residual;
    return result.outcome;
  }

  static constexpr int default_limit = 200;
  // The coarsest level needs 10 to 40 iterations from any shape that is not tangled up.
  static constexpr int first_try = 80;
  static constexpr double lost_at = 1e-3;

  const Model& model_;
  const FairOptions& options_;
  double size_;  // diagonal of the box around the net
  ThreadTeam& team_;
  Context& context_;
  ProgressReporter& progress_;
  FairReport& report_;
};

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
    EquilibriumRun(*model, options, diagonal(gathered.net), team, context, progress, report).run(gathered);
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
