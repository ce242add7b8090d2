#include "solve/surface_fairing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "base/cancellation.hpp"
#include "base/stopwatch.hpp"
#include "checks/new_crossings.hpp"
#include "checks/spring_energy.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/sweep_method.hpp"
#include "solve/fair_boundary.hpp"
#include "solve/papers_method.hpp"
#include "solve/part_of_mesh.hpp"
#include "solve/sphere_suited.hpp"

namespace vspring {

namespace {

bool hold_the_same(const Constraints& a, const Constraints& b) {
  if (a.node_count() != b.node_count()) return false;
  for (Index i = 0; i < a.node_count(); ++i) {
    if (a.position_fixed(i) != b.position_fixed(i) || a.normal_fixed(i) != b.normal_fixed(i) ||
        a.tangent_fixed(i) != b.tangent_fixed(i))
      return false;
  }
  return true;
}

bool was_found(const FairReport& report) {
  return report.outcome == Outcome::converged || report.outcome == Outcome::cancelled;
}

// As a share of the diagonal: for smaller tolerances rounding may have the last word, that of single precision in what
// the acceleration remembers, too. Other springs would then have another shape, for next to nothing.
constexpr double as_near_as_rounding = 1e-8;

/// Whether nothing else need be tried: it was found, or as nearly as rounding lets it be.
bool is_final(const FairReport& report) {
  return was_found(report) ||
         (report.outcome != Outcome::worse_than_input && report.expected_error.value_or(1) < as_near_as_rounding);
}

// On each level, of an even distribution where that of the input leads nowhere: the coarsest may need two starts.
constexpr int iterations_of_a_try = 100;
// Of the work that is allowed: what that try may take at least, where the flow from other spacing has left none.
constexpr double work_of_a_try = 0.2;
constexpr std::string_view ways_out =
    "hold more nodes, or normals, let a smaller region move, or only take its noise off";

// On each level, while somebody drags: what leads nowhere is for later.
constexpr int iterations_in_a_hurry = 40;

FairOptions in_a_hurry(FairOptions options) {
  std::visit(
      [](auto& method) {
        if (!method.max_iterations) method.max_iterations = iterations_in_a_hurry;
      },
      options.method);
  options.as_found = true;
  return options;
}

}  // namespace

SurfaceFairing::SurfaceFairing(const PolygonMesh& mesh, const FairOptions& options, int threads)
    : whole_(&mesh), options_(options), team_(threads), model_(surface_model(options.pseudo_normals, options.forces)) {}

FairResult SurfaceFairing::fair_once(const Constraints& constraints, Context& context) {
  const Stopwatch stopwatch;
  FairResult result;
  std::optional<Net> made = run(constraints, context, result.report, options_);
  if (!made) return unchanged(constraints, result, stopwatch);
  Net net = std::move(*made);
  if (hierarchy_) net = std::move(*hierarchy_).take();
  hierarchy_.reset();
  if (crosses_itself(net, constraints, context, result.report)) {
    net = gather_part(*whole_, part_, constraints);
    result.report.warnings.back().text +=
        ": this is the input with its constraints; hold more nodes, or let a smaller part move";
  }
  finish(net, constraints, result);
  result.report.seconds = stopwatch.seconds();
  return result;
}

FairResult SurfaceFairing::fair_again(const Constraints& constraints, Context& context,
                                      std::optional<double> tolerance) {
  const Stopwatch stopwatch;
  FairResult result;
  const bool is_doubtful = !tolerance && went_astray_;
  const bool went_on = !is_doubtful && fits_last(constraints) && go_on(constraints, context, tolerance, result.report);
  if (!went_on) {
    result = {};
    last_.reset();
    hierarchy_.reset();
    const auto net = run(constraints, context, result.report, tolerance ? in_a_hurry(options_) : options_);
    if (!net) return unchanged(constraints, result, stopwatch);
    if (!hierarchy_) {
      went_astray_ = false;
      (void)crosses_itself(*net, constraints, context, result.report);
      finish(*net, constraints, result);
      result.report.seconds = stopwatch.seconds();
      return result;
    }
  }
  const Net& net = hierarchy_->finest();
  const Outcome outcome = result.report.outcome;
  went_astray_ = tolerance && (went_astray_ || (outcome != Outcome::converged && outcome != Outcome::cancelled));
  if (tolerance) {
    result.report.moving_nodes = static_cast<Index>(net.moving);
    // Where a hurried run has led nowhere, the input with its constraints is a better picture.
    const bool is_of_use = went_on || outcome == Outcome::converged || check_->fault_of_places(net).empty();
    const auto scatter = [&](const Net& one) {
      return scatter_positions(one, whole_->positions(), constraints, options_.strength);
    };
    result.positions = is_of_use ? scatter(net) : scatter(gather_part(*whole_, part_, constraints));
  } else {
    (void)crosses_itself(net, constraints, context, result.report);
    finish(net, constraints, result);
  }
  if (went_on && outcome == Outcome::cancelled)
    hierarchy_->go_back();
  else if (went_on || (outcome == Outcome::converged && result.report.method == Method::equilibrium))
    last_ = constraints;
  result.report.seconds = stopwatch.seconds();
  return result;
}

std::optional<std::vector<Vector3>> SurfaceFairing::predict(const Constraints& constraints, double tolerance) {
  if (!fits_last(constraints)) return std::nullopt;
  const Net& net = hierarchy_->finest();
  const std::vector<Vector3> places = hierarchy_->predict(constraints, *model_, tolerance * diagonal(net));
  if (!std::all_of(places.begin(), places.end(), [](const Vector3& place) { return place.allFinite(); }))
    return std::nullopt;
  return scatter_places(net, places, whole_->positions(), constraints, options_.strength);
}

bool SurfaceFairing::fits_last(const Constraints& constraints) const {
  if (!last_ || !hold_the_same(*last_, constraints)) return false;
  // What is wrong there is said where all is looked at.
  for (Index node = 0; node < constraints.node_count(); ++node) {
    if (constraints.position_fixed(node) && !constraints.position(node).allFinite()) return false;
  }
  return true;
}

std::optional<Net> SurfaceFairing::run(const Constraints& constraints, Context& context, FairReport& report,
                                       const FairOptions& options) {
  part_ = active_submesh(*whole_, constraints);
  report.warnings = check_part(*whole_, part_, constraints);
  report.method = options.method_kind();
  ProgressReporter progress(context);
  progress.report("preparing", 0);
  report.threads = team_.size();
  const SolverCall call{team_, context, progress, report};
  try {
    const CancellationScope cancellation(context);
    if (const auto* const method = std::get_if<EquilibriumMethod>(&options.method)) {
      run_to_equilibrium(constraints, {call, options, *method});
      // It depends on these constraints. Where it was cancelled while it was made anew there is none.
      if (check_) check_->forget_start();
      return Net();
    }
    Net net = gather_part(*whole_, part_, constraints);
    look_at_start(net, constraints);
    net = run_papers_method(std::move(net), *model_, *check_, options, call);
    check_->forget_start();
    return net;
  } catch (const Cancelled&) {
    hierarchy_.reset();
    check_.reset();
    report.outcome = Outcome::cancelled;
    return std::nullopt;
  }
}

void SurfaceFairing::look_at_start(Net& net, const Constraints& constraints) {
  check_.emplace(net, *model_, team_, StartPlaces([this, &constraints](const Net& of) {
                   return start_places(of, whole_->positions(), constraints);
                 }));
}

FairResult SurfaceFairing::unchanged(const Constraints& constraints, FairResult& result,
                                     const Stopwatch& stopwatch) const {
  std::vector<std::uint8_t> in_faces(whole_->positions().size(), 0);
  for (const Index i : whole_->corners()) in_faces[static_cast<std::size_t>(i)] = 1;
  result.positions = positions_as_held(whole_->positions(), constraints);
  count_nodes(in_faces, constraints, result.report);
  result.report.faces = whole_->face_count();
  result.report.seconds = stopwatch.seconds();
  return std::move(result);
}

void SurfaceFairing::run_to_equilibrium(const Constraints& constraints, const EquilibriumCall& call) {
  const FairOptions& options = call.options;
  FairReport& report = call.report;
  const FairReport at_first = report;
  find_equilibrium(options.fair_by, constraints, call);
  if (options.springs == Springs::edge || options.fair_by == FairBy::curvature) return;
  if (report.springs == Springs::edge) {
    report.warnings.push_back(
        {WarningCode::other_springs,
         "least bending is for sphere springs, which would not see what is held here: these are edge springs"});
    return;
  }
  if (is_final(report) || call.method.max_iterations || options.as_found) return;
  const FairReport by_bending = std::exchange(report, at_first);
  find_equilibrium(FairBy::curvature, constraints, call);
  report.iterations += by_bending.iterations;
  report.work += by_bending.work;
  report.most_work += by_bending.most_work;
  report.warnings.push_back(
      {WarningCode::other_fairness, "no shape of least bending was found: this is fair by curvature"});
}

void SurfaceFairing::find_equilibrium(FairBy fair_by, const Constraints& constraints, const EquilibriumCall& call) {
  const FairOptions& options = call.options;
  const FairReport at_first = call.report;
  find_with_springs(fair_by, constraints, call);
  const std::optional<Fallbacks>& fallbacks = call.method.fallbacks;
  if (is_final(call.report) || !fallbacks || call.method.max_iterations || options.as_found) return;
  if (!options.distribution && try_evenly(fair_by, constraints, at_first, call)) return;
  if (call.report.fair_by == FairBy::curvature) try_sweeps(constraints, fallbacks->step_tolerance, call);
}

void SurfaceFairing::find_with_springs(FairBy fair_by, const Constraints& constraints, const EquilibriumCall& call) {
  const FairOptions& options = call.options;
  FairReport& report = call.report;
  bool spheres_have_none = false;
  for (const Springs springs : {Springs::sphere, Springs::edge}) {
    const bool is_sphere = springs == Springs::sphere;
    if (is_sphere && options.springs == Springs::edge) continue;
    Net net = gather_part(*whole_, part_, constraints, is_sphere);
    if (is_sphere && !suits_sphere_springs(net)) continue;
    const bool by_bending = is_sphere && fair_by == FairBy::bending;
    if (by_bending) use_least_bending(net);
    hierarchy_.reset();
    look_at_start(net, constraints);
    hierarchy_.emplace(surface_levels(std::move(net), *model_, options.distribution_taken(), team_), team_);
    // Whoever gives a number of iterations, or asks for what is found, gets that; edge springs come second else, and
    // after least bending curvature does.
    const bool is_try = is_sphere && !call.method.max_iterations && !options.as_found;
    const SearchTask task = {call.method, options.distribution, is_try || options.as_found, is_try};
    FairReport one = report;
    run_equilibrium(*hierarchy_, *model_, task, {team_, call.context, call.progress, one}, &*check_);
    if (is_try && one.outcome == Outcome::cancelled) go_back_if_worse(one);
    one.springs = springs;
    one.fair_by = by_bending ? FairBy::bending : FairBy::curvature;
    if (!is_try || by_bending || is_final(one)) {
      report = std::move(one);
      break;
    }
    spheres_have_none = true;
    report.iterations = one.iterations;
    report.work = one.work;
  }
  if (spheres_have_none)
    report.warnings.push_back(
        {WarningCode::other_springs, "sphere springs have no equilibrium here: these are edge springs"});
}

void SurfaceFairing::go_back_if_worse(FairReport& report) {
  Net& net = hierarchy_->finest();
  std::vector<Vector3> others = net.positions;
  for (std::size_t i = 0; i < net.moving; ++i) others[i] = net.frame.to_local(whole_->position(net.node[i]));
  if (net.positions == others) return;
  const std::string fault = check_->fault(net, true);
  if (fault.empty()) return;
  const bool is_nowhere = !check_->misplaced(net).empty();
  std::swap(net.positions, others);
  if (!is_nowhere && !check_->fault_of_places(net).empty()) {
    std::swap(net.positions, others);
    report.warnings.push_back({WarningCode::worse_than_input, "what was found is worse than the input: " + fault});
    return;
  }
  report.warnings.push_back({WarningCode::worse_than_input, "what was found so far is worse than the input (" + fault +
                                                                "): this is the input with its constraints"});
}

bool SurfaceFairing::try_evenly(FairBy fair_by, const Constraints& constraints, const FairReport& at_first,
                                const EquilibriumCall& call) {
  const std::vector<Vector3> nearest = hierarchy_->finest().positions;
  const bool was_with_spheres = hierarchy_->finest().spheres.on();
  FairReport& report = call.report;
  FairOptions options = options_;
  options.distribution = Distribution::even;
  options.as_found = true;
  EquilibriumMethod method = call.method;
  method.max_iterations = iterations_of_a_try;
  options.method = method;
  FairReport even = at_first;
  even.iterations = report.iterations;
  const double beyond = std::max(0.0, report.work - (1 - work_of_a_try) * report.most_work);
  even.work = report.work - beyond;
  even.most_work = report.most_work;
  try {
    find_with_springs(fair_by, constraints, {{team_, call.context, call.progress, even}, options, method});
  } catch (const Cancelled&) {
    even.outcome = Outcome::cancelled;
  }
  even.work += beyond;
  if (even.outcome == Outcome::converged) {
    report = std::move(even);
    report.warnings.push_back(
        {WarningCode::other_distribution,
         "with the spacing of the input no equilibrium was found: nodes go to the mean of their neighbours"});
    return true;
  }
  report.iterations = even.iterations;
  report.work = even.work;
  const bool was_cancelled = even.outcome == Outcome::cancelled;
  if (was_cancelled) report.outcome = Outcome::cancelled;
  if (fair_by == FairBy::bending && !was_cancelled) return false;
  // Nets with sphere springs have other nodes.
  Net net = gather_part(*whole_, part_, constraints, was_with_spheres);
  hierarchy_.reset();
  if (was_cancelled) {
    std::vector<Level> only(1);
    only[0].net = std::move(net);
    hierarchy_.emplace(std::move(only), team_);
  } else {
    look_at_start(net, constraints);
    hierarchy_.emplace(surface_levels(std::move(net), *model_, options_.distribution_taken(), team_), team_);
  }
  hierarchy_->finest().positions = nearest;
  return was_cancelled;
}

void SurfaceFairing::try_sweeps(const Constraints& constraints, double step_tolerance, const SolverCall& call) {
  FairReport& report = call.report;
  Net net = gather_part(*whole_, part_, constraints);
  set_laplacian_weights(net, *model_, options_.distribution_taken(), team_);
  const SweepMethod method = {.step_tolerance = step_tolerance, .max_iterations = sweeps_of_last_resort(net.moving)};
  FairReport of_sweeps;
  run_sweeps(net, *model_, method, {team_, call.context, call.progress, of_sweeps});
  report.work += of_sweeps.work;
  Net& nearest = hierarchy_->finest();
  update_directions(nearest, *model_, team_);
  update_directions(net, *model_, team_);
  const bool better = check_->fault(net).empty() && spring_energy(net).sum < spring_energy(nearest).sum;
  if (better) nearest.positions = net.positions;
  if (report.outcome == Outcome::worse_than_input) {
    if (!better) return;
    report.outcome = Outcome::stalled;
    // In place of what was said of that.
    const auto said = std::find_if(report.warnings.begin(), report.warnings.end(), [](const Warning& warning) {
      return warning.code == WarningCode::worse_than_input;
    });
    *said = {
        WarningCode::no_equilibrium,
        fmt::format(
            "no equilibrium was found that is no worse than the input: this is the plain iteration's shape, which is "
            "fairer; {}",
            ways_out)};
    return;
  }
  report.warnings.push_back(
      {WarningCode::no_equilibrium,
       fmt::format("no equilibrium was found (the nearest shape is {}): this is {}; {}",
                   distance_from_equilibrium(report),
                   better ? "the plain iteration's shape, which is fairer" : "that shape", ways_out)});
}

bool SurfaceFairing::go_on(const Constraints& constraints, Context& context, std::optional<double> tolerance,
                           FairReport& report) {
  const Net& net = hierarchy_->finest();
  if (part_) part_->constraints = constraints_of(constraints, part_->node);
  report.method = Method::equilibrium;
  report.springs = net.spheres.on() ? Springs::sphere : Springs::edge;
  report.fair_by = net.spheres.differences.empty() ? FairBy::curvature : FairBy::bending;
  ProgressReporter progress(context);
  report.threads = team_.size();
  auto method = std::get<EquilibriumMethod>(options_.method);
  if (tolerance) method.tolerance = *tolerance;
  hierarchy_->update(constraints, *model_, method.tolerance * diagonal(net));
  run_equilibrium_from_near(*hierarchy_, hierarchy_->kept_preconditioner(), *model_, method,
                            {team_, context, progress, report}, nullptr, &hierarchy_->memory(), tolerance.has_value());
  if (report.outcome == Outcome::cancelled) return true;
  if (report.outcome != Outcome::converged) return false;
  const std::string fault = check_->fault_of_places(net);
  if (!fault.empty()) {
    // Who has dragged something too far sees it, and drags it back.
    if (!tolerance && !options_.as_found) return false;
    report.outcome = Outcome::worse_than_input;
    report.warnings.push_back({WarningCode::worse_than_input, "this is worse than the input: " + fault});
  }
  hierarchy_->arrived();
  return true;
}

bool SurfaceFairing::crosses_itself(const Net& net, const Constraints& constraints, Context& context,
                                    FairReport& report) {
  const std::string crossings = new_crossings(
      *whole_, scatter_positions(net, whole_->positions(), constraints, options_.strength), context, team_);
  if (crossings.empty()) return false;
  report.outcome = Outcome::worse_than_input;
  report.warnings.push_back({WarningCode::worse_than_input, "what was found is worse than the input: " + crossings});
  return report.method == Method::equilibrium && !options_.as_found;
}

void SurfaceFairing::finish(const Net& net, const Constraints& constraints, FairResult& result) {
  FairReport& report = result.report;
  count_nodes(net.moving, constraints, report);
  report.faces = whole_->face_count();
  result.positions = scatter_positions(net, whole_->positions(), constraints, options_.strength);
  measure_moves(net, whole_->positions(), result.positions, report);
}

}  // namespace vspring
