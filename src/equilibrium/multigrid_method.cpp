#include "equilibrium/multigrid_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/cancellation.hpp"
#include "base/stopwatch.hpp"
#include "equilibrium/sweep_method.hpp"

namespace vspring {

namespace {

// The coarsest level goes on until steps are this much smaller than on the others.
constexpr double coarsest_share = 1e-3;

class Cycle {
 public:
  Cycle(Hierarchy& hierarchy, const Model& model, const MultigridMethod& method, const SolverCall& call,
        PointLevels* points)
      : hierarchy_(hierarchy),
        model_(model),
        method_(method),
        team_(call.team),
        context_(call.context),
        progress_(call.progress),
        report_(call.report),
        points_(points) {}

  void run() {
    const std::size_t by_default = hierarchy_.count() - hierarchy_.first_of_use();
    hierarchy_.limit(method_.levels ? static_cast<std::size_t>(*method_.levels) : by_default);
    const std::size_t finest = hierarchy_.count() - 1;
    report_.levels.assign(hierarchy_.count(), {.outcome = Outcome::cancelled, .strategy = "V-cycle"});
    for (std::size_t k = 0; k <= finest; ++k)
      report_.levels[k].moving_nodes = static_cast<Index>(hierarchy_.net(k).moving);
    for (std::size_t k = finest; k > 0; --k) {
      report_.outcome = iterate(k, 0, method_.pre_smoothing).outcome;
      if (report_.outcome == Outcome::cancelled) return;
      hierarchy_.restrict_from(k);
    }
    for (std::size_t k = 0;; ++k) {
      const double share = k == 0 && finest > 0 ? coarsest_share : 1;
      const SweepResult result = iterate(k, share * method_.step_tolerance, method_.max_iterations);
      report_.outcome = result.outcome;
      report_.residual = result.residual;
      report_.levels[k].outcome = result.outcome;
      if (result.lost) lost_ = true;
      if (k == finest) break;
      // The result of coarser levels is handed up also after a cancellation.
      const UncancelledScope whole;
      update_directions(hierarchy_.net(k), model_, team_);
      if (context_.cancelled())
        hierarchy_.prolong_roughly_from(k);
      else
        hierarchy_.prolong_from(k);
    }
    if (lost_) warn_of_growing_steps(report_);
    say_if_cut_short();
  }

 private:
  /// A finer level removes short waves and hardly changes long ones, so its steps may be small although the shape is
  /// far from its equilibrium.
  void say_if_cut_short() {
    const auto coarser = std::span(report_.levels).first(report_.levels.size() - 1);
    const auto cut_short = std::find_if(coarser.begin(), coarser.end(), [](const LevelReport& level) {
      return level.outcome == Outcome::iteration_limit;
    });
    if (cut_short == coarser.end()) return;
    report_.warnings.push_back(
        {WarningCode::level_cut_short,
         fmt::format("{} level, of {} moving nodes, ended at its limit of {} iterations: the shape may be far from its "
                     "equilibrium though its last steps are small",
                     cut_short == coarser.begin() ? "the coarsest" : "a coarser", cut_short->moving_nodes,
                     method_.max_iterations),
         {{Remedy::iterations, "allow more iterations"}, {Remedy::method, "take the method equilibrium"}}});
  }

  SweepResult iterate(std::size_t level, double step_tolerance, int max_iterations) {
    const Stopwatch stopwatch;
    SweepTask task{.step_tolerance = step_tolerance,
                   .max_iterations = max_iterations,
                   .order = method_.order,
                   .keep_last = method_.keep_last};
    const auto nodes = static_cast<double>(hierarchy_.net(level).moving);
    const double share = nodes / static_cast<double>(hierarchy_.net(hierarchy_.count() - 1).moving);
    task.on_iteration = [&](double residual) {
      report_.history.push_back(residual);
      ++report_.iterations;
      // A level's work is in proportion to its nodes, and all coarser ones together take a third of it.
      progress_.report("fairing", step_tolerance > 0 ? share * 0.7 : 0, report_.iterations, residual);
    };
    if (points_) {
      try {
        // A shape that is handed up after a cancellation needs no ties.
        if (!context_.cancelled()) points_->tie(level);
      } catch (const Cancelled&) {
        // Sweeps end at once.
      }
      task.renew_ties = [&] { (void)points_->renew(0); };
    }
    const SweepResult result = sweep_until_still(hierarchy_.net(level), model_, task, team_, context_);
    report_.levels[level].iterations += result.iterations;
    report_.levels[level].seconds += stopwatch.seconds();
    return result;
  }

  Hierarchy& hierarchy_;
  const Model& model_;
  const MultigridMethod& method_;
  ThreadTeam& team_;
  Context& context_;
  ProgressReporter& progress_;
  FairReport& report_;
  PointLevels* points_;
  bool lost_ = false;
};

}  // namespace

void run_multigrid(Hierarchy& hierarchy, const Model& model, const MultigridMethod& method, const SolverCall& call,
                   PointLevels* points) {
  Cycle(hierarchy, model, method, call, points).run();
}

}  // namespace vspring
