#include "vspring/fair.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "fairness/measure.hpp"
#include "solve/sweep_method.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

void count(const PolygonMesh& mesh, const Constraints& constraints, const Net& net, FairReport& report) {
  report.nodes = mesh.node_count();
  report.faces = mesh.face_count();
  report.moving_nodes = static_cast<Index>(net.moving);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    report.fixed_positions += constraints.position_fixed(i) ? 1 : 0;
    report.fixed_normals += constraints.normal_fixed(i) ? 1 : 0;
  }
}

void measure_moves(const PolygonMesh& mesh, const Net& net, const std::vector<Vector3>& positions, FairReport& report) {
  double squares = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Vector3 move =
        (positions[static_cast<std::size_t>(net.node[i])] - mesh.position(net.node[i])) * net.frame.scale();
    const double square = move.dot(move);
    squares += square;
    report.greatest_move = std::max(report.greatest_move, std::sqrt(square) / net.frame.scale());
  }
  if (net.moving > 0) report.mean_move = std::sqrt(squares / static_cast<double>(net.moving)) / net.frame.scale();
}

}  // namespace

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::converged:
      return "converged";
    case Outcome::iteration_limit:
      return "iteration-limit";
    case Outcome::stalled:
      return "stalled";
    case Outcome::cancelled:
      return "cancelled";
  }
  return "";
}

void FairOptions::validate() const {
  const auto require = [](bool holds, const char* option, const char* range, double value) {
    if (!holds) throw Error(ErrorCode::invalid_argument, fmt::format("{} must be {}, not {}", option, range, value));
  };
  require(step_tolerance > 0 && std::isfinite(step_tolerance), "step tolerance", "greater than 0", step_tolerance);
  require(max_iterations >= 0, "maximum of iterations", "0 or more", max_iterations);
  require(strength >= 0 && strength <= 1, "strength", "from 0 to 1", strength);
}

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options, Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  options.validate();
  FairResult result;
  FairReport& report = result.report;
  report.warnings = check_constraints(mesh, constraints);

  ProgressReporter progress(context);
  progress.report("preparing", 0);
  ThreadTeam team(context.thread_count());
  report.threads = team.size();
  Net net = gather_net(mesh, constraints);
  count(mesh, constraints, net, report);
  report.before = measure(mesh, &constraints, team);

  const auto model = surface_model(options.pseudo_normals);
  distribute(net, *model, options.distribution, team);
  run_sweeps(net, *model, options, team, context, progress, report);

  result.positions = scatter_positions(net, mesh.positions(), constraints, options.strength);
  measure_moves(mesh, net, result.positions, report);
  PolygonMesh faired = mesh;
  faired.set_positions(result.positions);
  report.after = measure(faired, &constraints, team);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(mesh, constraints, options, context);
}

}  // namespace vspring
