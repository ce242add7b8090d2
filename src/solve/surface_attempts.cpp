// Ways towards the equilibrium of a surface, one after the other.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "checks/bending_energy.hpp"
#include "checks/result_check.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/relaxation.hpp"
#include "solve/attempt.hpp"
#include "solve/part_of_mesh.hpp"
#include "solve/sphere_suited.hpp"
#include "solve/surface_fairing.hpp"

namespace vspring {

namespace {

// What leads somewhere takes up to some 150.
constexpr int most_steps_of_bending = 200;
// On each level, of another distribution where the one that was asked for leads nowhere: the coarsest may need two
// starts.
constexpr int iterations_of_a_try = 100;
// Of the work that is allowed: what that try may take at least.
constexpr double work_of_a_try = 0.2;
// All steps of less bending may take so many times the work that is allowed.
constexpr double work_of_bending = 3;

/// Once more as the last, of the attempts from there on that stand, the one with the fewest nodes in creases; of these
/// the one that is bent least. False where none does.
bool repeat_best_of(std::vector<Attempt>& attempts, std::size_t from) {
  const auto is_better = [](const Attempt& a, const Attempt& b) {
    return a.creased != b.creased ? a.creased < b.creased : a.bent < b.bent;
  };
  const Attempt* best = nullptr;
  for (const Attempt& attempt : std::span(attempts).subspan(from)) {
    if (attempt.stands() && (!best || is_better(attempt, *best))) best = &attempt;
  }
  if (best) attempts.push_back(Attempt(*best));
  return best != nullptr;
}

}  // namespace

void SurfaceFairing::run_to_equilibrium(const Constraints& constraints, const EquilibriumCall& call) {
  const FairOptions& options = call.options;
  // Whoever gives a number of iterations, or asks for what is found, gets that.
  const bool is_only = call.method.max_iterations || options.accept_worse;
  std::vector<Attempt> attempts;
  const auto go_on = [&] { return !is_only && !attempts.back().is_final(); };
  attempts.push_back(go_from_coarse_levels(options.springs, constraints, call));
  if (go_on() && attempts.back().springs == Springs::sphere && options.fair_by == FairBy::curvature)
    attempts.push_back(go_from_coarse_levels(Springs::edge, constraints, call));
  const bool may_be_another = call.method.fallbacks;
  if (may_be_another && go_on() && !options.distribution) attempts.push_back(go_evenly(constraints, call));
  if (may_be_another && go_on()) go_by_less_bending(attempts, constraints, call);
  take_best(std::move(attempts), constraints, call);
}

void SurfaceFairing::go_by_less_bending(std::vector<Attempt>& attempts, const Constraints& constraints,
                                        const EquilibriumCall& call) {
  hierarchy_.reset();
  make_levels(gather(constraints, true), call.options);
  Relaxation relaxation(*hierarchy_, *model_, call.method, call, nullptr);
  FairReport& report = call.report;
  const double allowed = report.most_work;
  const double in_all = report.work + work_of_bending * allowed;
  Net& net = hierarchy_->finest();
  const std::vector<Vector3> start = net.positions;
  std::vector<Vector3> best = start;
  measure_bending(attempts);
  if (const Attempt* const one = bent_least(attempts, bent_of(start, BendingEnergy(net))))
    std::copy(one->places.begin(), one->places.end(), best.begin());
  const bool is_folded = turned_edges(net, best, team_) > 0;
  const std::size_t first = attempts.size();
  const auto go = [&](std::optional<double> smoothing_length) {
    report.most_work = std::min(in_all, report.work + allowed);
    attempts.push_back(bend_less(relaxation, start, smoothing_length, constraints, call));
    const Attempt& end = attempts.back();
    const bool is_sure = smoothing_length || end.expected_error.value_or(1) < call.method.tolerance;
    if (end.outcome == Outcome::cancelled || (end.is_final() && end.creased == 0 && is_sure)) return true;
    keep_places(attempts.back());
    return false;
  };
  const auto go_from_best = [&] {
    net.positions = best;
    return go(std::nullopt);
  };
  // That has no folds, and no node need stay in place of one.
  const auto go_from_membrane = [&] {
    hierarchy_->start_from_membrane(relaxation.last());
    return go(std::nullopt);
  };
  const auto repeat_best = [&] {
    measure_bending(attempts);
    return repeat_best_of(attempts, first);
  };
  const auto go_near_start = [&](double smoothing_length) {
    net.positions = start;
    return go(smoothing_length);
  };
  const auto go_freely = [&] {
    if (is_folded) return go_from_membrane() || go_from_best();
    return go_from_best() || (attempts.back().stands() && go_from_membrane());
  };
  const auto is_smooth = [](const Attempt& one) { return one.stands() && one.creased == 0; };
  const auto some_is_smooth = [&] {
    return std::any_of(attempts.begin() + static_cast<std::ptrdiff_t>(first), attempts.end(), is_smooth);
  };
  const bool is_done =
      go_freely() ||
      (!some_is_smooth() && std::any_of(smoothing_lengths.begin(), smoothing_lengths.end(), go_near_start)) ||
      repeat_best();
  report.most_work = in_all;
  if (is_done) return;
  // With folds that the input has, too, rather than none at all.
  const auto found = std::find_if(attempts.begin(), attempts.end(), [](const Attempt& one) {
    return one.outcome == Outcome::converged && one.fault.empty();
  });
  if (found == attempts.end()) return;
  attempts.push_back(Attempt(*found));
  attempts.back().keeps_folds = false;
  attempts.back().remark += "; it has folds, as the input does";
}

void SurfaceFairing::take_best(std::vector<Attempt> attempts, const Constraints& constraints,
                               const EquilibriumCall& call) {
  Net& net = hierarchy_->finest();
  Attempt& last = attempts.back();
  StartShape start;
  if (!last.is_final() || !last.fault.empty()) {
    if (last.places.empty()) keep_places(last);
    net.positions = start_places(net, whole_->positions(), constraints);
    start.is_sound = check_->fault_of_places(net).empty();
    if (attempts.size() > 1 && !last.is_final()) {
      measure_bending(attempts);
      start.bent = bent_of(net.positions, BendingEnergy(net));
    }
  }
  const Attempt* const best = pick(attempts, start, call.options, call.report);
  // What is final is where the net is.
  if (best && !best->places.empty()) std::copy(best->places.begin(), best->places.end(), net.positions.begin());
}

void SurfaceFairing::measure_bending(std::vector<Attempt>& attempts) {
  const BendingEnergy bending(hierarchy_->finest());
  std::vector<Vector3> positions = hierarchy_->finest().positions;
  for (Attempt& attempt : attempts) {
    std::copy(attempt.places.begin(), attempt.places.end(), positions.begin());
    attempt.bent = bent_of(positions, bending);
  }
}

Bent SurfaceFairing::bent_of(const std::vector<Vector3>& positions, const BendingEnergy& bending) {
  return {turned_edges(hierarchy_->finest(), positions, team_), bending.of(positions, team_)};
}

Attempt SurfaceFairing::attempt(const Constraints& constraints, const EquilibriumCall& call) {
  Net& net = hierarchy_->finest();
  Attempt result;
  result.springs = net.spheres.on() ? Springs::sphere : Springs::edge;
  result.fair_by = net.spheres.differences.empty() ? FairBy::curvature : FairBy::bending;
  result.outcome = call.report.outcome;
  // A limit that nobody gave.
  if (result.outcome == Outcome::iteration_limit && !call.method.max_iterations) result.outcome = Outcome::work_limit;
  result.expected_error = call.report.expected_error;
  result.remark = words_of_kept(call.report);
  const Index kept = call.report.levels.empty() ? 0 : call.report.levels.back().kept_nodes;
  result.creased = kept > 0 && check_->turns_more(net) ? kept : 0;
  if (result.outcome == Outcome::cancelled && net.positions == start_places(net, input().positions(), constraints))
    return result;
  call.progress.report("checking", 0.5);
  try {
    result.fault = check_->fault(net);
  } catch (const Cancelled&) {
    // That is thrown once. What was only half looked at is looked at whole.
    result.outcome = Outcome::cancelled;
    result.fault = check_->fault(net);
  }
  if (result.fault.empty() && call.looks_at_crossings && result.outcome != Outcome::cancelled) {
    // The search needs as much memory.
    if (!goes_on_) hierarchy_->forget_preconditioner();
    result.fault = crossings(net, constraints, call.context);
  }
  result.keeps_folds = result.outcome == Outcome::converged && !options_.accept_worse && check_->keeps_folds(net);
  if (!result.is_final() || !result.fault.empty()) result.is_misplaced = !check_->misplaced(net).empty();
  if (!result.is_final()) {
    keep_places(result);
    call.progress.begin_anew();
  }
  return result;
}

void SurfaceFairing::keep_places(Attempt& attempt) const {
  const std::vector<Vector3>& positions = hierarchy_->finest().positions;
  attempt.places.assign(positions.begin(),
                        positions.begin() + static_cast<std::ptrdiff_t>(hierarchy_->finest().moving));
}

Attempt SurfaceFairing::go_from_coarse_levels(Springs springs, const Constraints& constraints,
                                              const EquilibriumCall& call) {
  const FairOptions& options = call.options;
  hierarchy_.reset();
  std::optional<Net> net;
  if (springs == Springs::sphere) net = gather(constraints, true);
  if (net && !suits_sphere_springs(*net)) net.reset();
  if (!net) net = gather(constraints, false);
  if (net->spheres.on() && options.fair_by == FairBy::bending) use_least_bending(*net);
  make_levels(std::move(*net), options);
  run_equilibrium(*hierarchy_, *model_, {call.method, options.distribution}, call);
  return attempt(constraints, call);
}

void SurfaceFairing::make_levels(Net net, const FairOptions& options) {
  check_.emplace(net, team_);
  hierarchy_.emplace(surface_levels(std::move(net), *model_, options.distribution_taken(), team_), team_);
}

Attempt SurfaceFairing::go_evenly(const Constraints& constraints, const EquilibriumCall& call) {
  FairReport& report = call.report;
  FairOptions options = call.options;
  options.distribution = Distribution::even;
  options.accept_worse = true;
  EquilibriumMethod method = call.method;
  method.max_iterations = iterations_of_a_try;
  const double most_work = report.most_work;
  report.most_work = std::max(most_work, report.work + work_of_a_try * most_work);
  Attempt result =
      go_from_coarse_levels(options.springs, constraints, {call, options, method, call.looks_at_crossings});
  report.most_work = std::max(most_work, report.work);
  result.is_even = true;
  return result;
}

Attempt SurfaceFairing::bend_less(Relaxation& relaxation, std::span<const Vector3> start,
                                  std::optional<double> smoothing_length, const Constraints& constraints,
                                  const EquilibriumCall& call) {
  Net& net = hierarchy_->finest();
  use_least_bending(net);
  relaxation.set_strategy(smoothing_length ? "less bending, near the input" : "less bending");
  const auto home = smoothing_length ? start : std::span<const Vector3>();
  relaxation.bend_less(most_steps_of_bending, home, smoothing_length.value_or(0));
  Attempt result = attempt(constraints, call);
  if (smoothing_length) {
    result.remark += fmt::format(
        "; it stays near the input (smoothing length {:.2g}), as it would fold, cross itself or swell for ever",
        *smoothing_length * relaxation.size() / net.frame.scale());
  } else if (result.outcome == Outcome::converged && is_underconstrained(net)) {
    // One of a family is none to be called the one.
    result.outcome = Outcome::stalled;
    keep_places(result);
  }
  return result;
}

}  // namespace vspring
