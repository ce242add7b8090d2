#include "solve/surface_fairing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "base/cancellation.hpp"
#include "base/stopwatch.hpp"
#include "checks/new_crossings.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "solve/carried.hpp"
#include "solve/fair_boundary.hpp"
#include "solve/papers_method.hpp"
#include "solve/part_of_mesh.hpp"
#include "solve/sphere_suited.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

bool hold_the_same(const Constraints& a, const Constraints& b) {
  if (a.node_count() != b.node_count() || a.corner_count() != b.corner_count()) return false;
  for (Index i = 0; i < a.node_count(); ++i) {
    if (a.position_fixed(i) != b.position_fixed(i) || a.normal_fixed(i) != b.normal_fixed(i) ||
        a.tangent_fixed(i) != b.tangent_fixed(i) || a.support(i) != b.support(i))
      return false;
    // A given normal says where to a node slides.
    if (a.support(i) != nullptr && a.normal_fixed(i) && a.normal(i) != b.normal(i)) return false;
  }
  return true;
}

// On each level, while somebody drags: what leads nowhere is for later.
constexpr int iterations_in_a_hurry = 40;

FairOptions in_a_hurry(FairOptions options) {
  std::visit(
      [](auto& method) {
        if (!method.max_iterations) method.max_iterations = iterations_in_a_hurry;
      },
      options.method);
  options.accept_worse = true;
  return options;
}

}  // namespace

SurfaceFairing::SurfaceFairing(const PolygonMesh& mesh, const FairOptions& options, int threads)
    : whole_(&mesh), options_(options), team_(threads), model_(surface_model(options.pseudo_normals, options.forces)) {}

FairResult SurfaceFairing::fair_once(const Constraints& constraints, Context& context) {
  const Stopwatch stopwatch;
  FairResult result;
  std::optional<Net> made = run(constraints, context, result.report, options_, true);
  if (!made) return unchanged(constraints, result, stopwatch);
  Net net = std::move(*made);
  if (hierarchy_) net = std::move(*hierarchy_).take();
  hierarchy_.reset();
  finish(net, constraints, result);
  result.report.seconds = stopwatch.seconds();
  return result;
}

FairResult SurfaceFairing::fair_again(const Constraints& constraints, Context& context,
                                      std::optional<double> tolerance) {
  const Stopwatch stopwatch;
  FairResult result;
  goes_on_ = true;
  const bool is_doubtful = !tolerance && went_astray_;
  const bool went_on = !is_doubtful && fits_last(constraints) && go_on(constraints, context, tolerance, result.report);
  if (!went_on) {
    result = {};
    last_.reset();
    hierarchy_.reset();
    const auto net = run(constraints, context, result.report, tolerance ? in_a_hurry(options_) : options_, !tolerance);
    if (!net) return unchanged(constraints, result, stopwatch);
    if (!hierarchy_) {
      went_astray_ = false;
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
    if (went_on) warn_of_crossings(net, constraints, context, result.report);
    finish(net, constraints, result);
  }
  if (went_on && outcome == Outcome::cancelled)
    hierarchy_->go_back();
  else if (went_on || (outcome == Outcome::converged && result.report.method == Method::equilibrium &&
                       result.report.fair_by == options_.fair_by))
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
                                       const FairOptions& options, bool looks_at_crossings) {
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
      // Of other nodes, perhaps.
      carrying_.reset();
      carrying_moves_.clear();
      carried_.reset();
      (void)carry_along(constraints);
      run_to_equilibrium(constraints, {call, options, *method, looks_at_crossings});
      return Net();
    }
    Net net = gather(constraints, false);
    check_.emplace(net, team_);
    net = run_papers_method(std::move(net), *model_, *check_, options, call);
    if (looks_at_crossings && !context.cancelled()) warn_of_crossings(net, constraints, context, report);
    return net;
  } catch (const Cancelled&) {
    hierarchy_.reset();
    check_.reset();
    report.outcome = Outcome::cancelled;
    return std::nullopt;
  }
}

bool SurfaceFairing::carry_along(const Constraints& constraints) {
  const PolygonMesh& mesh = part_ ? part_->mesh : *whole_;
  const Constraints& held = part_ ? part_->constraints : constraints;
  std::vector<Vector3> moves = carrying_moves(mesh, held);
  if (moves == carrying_moves_) return false;
  carrying_moves_ = std::move(moves);
  carried_.reset();
  if (carrying_moves_.empty()) return true;
  if (!carrying_ || !carrying_->are_for(carrying_moves_)) carrying_.emplace(mesh, held, carrying_moves_, team_);
  auto positions = carrying_->positions_with(carrying_moves_);
  if (!positions) return true;
  std::vector<Vector3> all = whole_->positions();
  for (std::size_t k = 0; k < positions->size(); ++k)
    all[part_ ? static_cast<std::size_t>(part_->node[k]) : k] = (*positions)[k];
  carried_.emplace(*whole_).set_positions(std::move(all));
  return true;
}

Net SurfaceFairing::gather(const Constraints& constraints, bool for_spheres) const {
  if (!part_ || !carried_) return gather_part(input(), part_, constraints, for_spheres);
  ActiveSubmesh part = *part_;
  part.mesh.set_positions(values_of(carried_->positions(), part.node));
  return gather_part(*carried_, part, constraints, for_spheres);
}

/// As make_levels() does it.
void SurfaceFairing::space_as_carried(const Constraints& constraints) {
  Net& net = hierarchy_->finest();
  net.input.resize(net.node.size());
  for (std::size_t i = 0; i < net.node.size(); ++i) net.input[i] = net.frame.to_local(input().position(net.node[i]));
  std::vector<Vector3> now = std::exchange(net.positions, start_places(net, input().positions(), constraints));
  set_laplacian_weights(net, *model_, options_.distribution_taken(), team_);
  net.positions = std::move(now);
  hierarchy_->set_laplacian_weights(std::move(net.laplacian_weights));
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
  if (carry_along(constraints)) space_as_carried(constraints);
  hierarchy_->update(constraints, *model_, method.tolerance * diagonal(net));
  run_equilibrium_from_near(*hierarchy_, hierarchy_->kept_preconditioner(), *model_, method,
                            {team_, context, progress, report}, nullptr, &hierarchy_->memory(), tolerance.has_value());
  if (report.outcome == Outcome::cancelled) return true;
  if (report.outcome != Outcome::converged) return false;
  const std::string fault = check_->fault_of_places(net);
  if (!fault.empty()) {
    // Who has dragged something too far sees it, and drags it back.
    if (!tolerance && !options_.accept_worse) return false;
    report.outcome = Outcome::worse_than_input;
    report.warnings.push_back({WarningCode::worse_than_input, "this is worse than the input: " + fault});
  }
  hierarchy_->arrived();
  return true;
}

std::string SurfaceFairing::crossings(const Net& net, const Constraints& constraints, Context& context) {
  return new_crossings(*whole_, scatter_positions(net, whole_->positions(), constraints, options_.strength), context,
                       team_);
}

void SurfaceFairing::warn_of_crossings(const Net& net, const Constraints& constraints, Context& context,
                                       FairReport& report) {
  const std::string found = crossings(net, constraints, context);
  if (found.empty()) return;
  report.outcome = Outcome::worse_than_input;
  report.warnings.push_back({WarningCode::worse_than_input, "what was found is worse than the input: " + found});
}

void SurfaceFairing::finish(const Net& net, const Constraints& constraints, FairResult& result) {
  FairReport& report = result.report;
  count_nodes(net.moving, constraints, report);
  report.faces = whole_->face_count();
  result.positions = scatter_positions(net, whole_->positions(), constraints, options_.strength);
  measure_moves(net, whole_->positions(), result.positions, report);
}

}  // namespace vspring
