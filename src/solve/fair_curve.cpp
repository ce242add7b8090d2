// Curves (§4.8).

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/cancellation.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "checks/result_check.hpp"
#include "constraints/holding.hpp"
#include "constraints/sides.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/from_options.hpp"
#include "equilibrium/relaxation.hpp"
#include "solve/attempt.hpp"
#include "solve/curve_curvature_join.hpp"
#include "solve/papers_method.hpp"
#include "spring/curve_net.hpp"
#include "start/curve_noise.hpp"
#include "start/winding.hpp"
#include "vspring/fair.hpp"

namespace vspring {

namespace {

// From a curve that is nearly there.
constexpr int newton_limit = 20;
// Radians by which a curve may turn over a smoothing length, in the mean: windings lose a sixteenth of their radius
// then.
constexpr double most_turn = 0.5;

/// By how much a curve turns at its nodes, for its length, in the mean.
double mean_curvature(const Net& net) {
  double turn = 0;
  double length = 0;
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    if (links.size() < 2) continue;
    const Vector3 before = net.positions[i] - net.positions[links[0].node()];
    const Vector3 after = net.positions[links[1].node()] - net.positions[i];
    turn += std::atan2(before.cross(after).norm(), before.dot(after));
    length += (before.norm() + after.norm()) / 2;
  }
  return length > 0 ? turn / length : 0;
}

/// The curve on its way, as attempts at its equilibrium see it.
class CurveFairing {
 public:
  CurveFairing(Hierarchy& hierarchy, const Model& model, const ResultCheck& check, const FairOptions& options,
               const SolverCall& call)
      : hierarchy_(hierarchy),
        model_(model),
        check_(check),
        options_(options),
        method_(std::get<EquilibriumMethod>(options.method)),
        call_(call),
        input_(net().positions) {}

  /// Leaves what was found in the net, and says in the report what that is.
  void run() {
    std::vector<Attempt> attempts;
    run_equilibrium(hierarchy_, model_, search_task(options_), call_);
    attempts.push_back(attempt(FairBy::curvature));
    // Whoever gives a number of iterations, or asks for what is found, gets that.
    const bool is_only = method_.max_iterations || options_.accept_worse || !method_.fallbacks;
    if (!is_only && !attempts.back().is_final()) go_from_input(attempts);
    take_best(attempts);
  }

 private:
  Net& net() { return hierarchy_.finest(); }

  /// Springs may have an equilibrium near a start that winds as the input does; else the answer is what is bent least
  /// near the input.
  void go_from_input(std::vector<Attempt>& attempts) {
    // Tolerances are shares of its size.
    net().positions = input_;
    Relaxation relaxation(hierarchy_, model_, method_, call_, nullptr);
    // As much again.
    call_.report.most_work += call_.report.work;
    smooth_noise(net());
    const std::vector<Vector3> smooth = net().positions;
    if (wind(net())) {
      relaxation.set_strategy("from linear curvature");
      relaxation.relax_by_newton(newton_limit);
      attempts.push_back(attempt(FairBy::curvature));
      if (attempts.back().is_final()) return;
    }
    relaxation.set_strategy("less bending, near the input");
    for (const double smoothing_length : smoothing_lengths) {
      net().positions = smooth;
      relaxation.smooth_near(input_, smoothing_length);
      const bool is_last = smoothing_length == smoothing_lengths.back();
      if (!is_last && mean_curvature(net()) * smoothing_length * relaxation.size() > most_turn) continue;
      attempts.push_back(attempt(FairBy::bending));
      attempts.back().remark = fmt::format(
          " (smoothing length {:.2g}); to stay nearer hold more nodes, or fit it to its own nodes within a tolerance",
          smoothing_length * relaxation.size() / net().frame.scale());
      if (attempts.back().is_final()) return;
    }
  }

  Attempt attempt(FairBy fair_by) {
    Attempt result;
    result.springs = options_.springs;
    result.fair_by = fair_by;
    result.outcome = call_.report.outcome;
    result.expected_error = call_.report.expected_error;
    call_.progress.report("checking", 0.5);
    try {
      result.fault = fault();
    } catch (const Cancelled&) {
      result.outcome = Outcome::cancelled;
      result.fault = fault();
    }
    if (!result.is_final() || !result.fault.empty()) result.is_misplaced = !check_.misplaced(net()).empty();
    if (!result.is_final()) {
      keep_places(result);
      call_.progress.begin_anew();
    }
    return result;
  }

  /// What is worse than at the start; empty where nothing is.
  std::string fault() {
    std::string fault = check_.fault(net());
    if (fault.empty() && lost_winding(net(), input_)) fault = "it winds otherwise than the input";
    return fault;
  }

  void keep_places(Attempt& attempt) {
    const auto begin = net().positions.begin();
    attempt.places.assign(begin, begin + static_cast<std::ptrdiff_t>(net().moving));
  }

  void take_best(std::vector<Attempt>& attempts) {
    Attempt& last = attempts.back();
    StartShape start;
    if (!last.is_final() || !last.fault.empty()) {
      if (last.places.empty()) keep_places(last);
      std::vector<Vector3> positions = input_;
      for (Attempt& attempt : attempts) {
        std::copy(attempt.places.begin(), attempt.places.end(), positions.begin());
        attempt.bent = bent_of(positions);
      }
      net().positions = input_;
      start = {check_.fault_of_places(net()).empty(), bent_of(input_)};
    }
    const Attempt* const best = pick(attempts, start, options_, call_.report);
    if (best && !best->places.empty()) std::copy(best->places.begin(), best->places.end(), net().positions.begin());
  }

  Bent bent_of(const std::vector<Vector3>& positions) {
    return {turned_edges(net(), positions, call_.team), bending_of_curve(net(), positions)};
  }

  Hierarchy& hierarchy_;
  const Model& model_;
  const ResultCheck& check_;
  const FairOptions& options_;
  const EquilibriumMethod& method_;
  const SolverCall& call_;
  const std::vector<Vector3> input_;
};

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
  const ResultCheck check(net, team);
  const SolverCall call{team, context, progress, report};
  if (report.method == Method::equilibrium) {
    const Distribution distribution = distribution_of(net, options);
    const std::vector<Vector3> input = net.positions;
    const std::unique_ptr<Hierarchy> hierarchy = hierarchy_of(std::move(net), *model, distribution, team);
    CurveFairing(*hierarchy, *model, check, options, call).run();
    net = std::move(*hierarchy).take();
    if (options.continuity == Continuity::curvature)
      join_with_curvature(curve, constraints, options, check, input, context, progress, net, report);
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
