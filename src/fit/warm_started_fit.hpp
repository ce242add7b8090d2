#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "equilibrium/equilibrium_method.hpp"
#include "equilibrium/from_options.hpp"
#include "equilibrium/multigrid_method.hpp"
#include "equilibrium/point_levels.hpp"
#include "equilibrium/sweep_method.hpp"
#include "points/point_factors.hpp"
#include "points/point_ties.hpp"
#include "spring/model.hpp"
#include "start/smooth_start.hpp"

namespace vspring {

/// Scattered points as they come, and the nodes of the shape that are nearest to them. Freed when they are tied.
struct UntiedPoints {
  std::span<const Vector3> positions;
  std::vector<double> weights;
  std::vector<Index> nearest;
  std::span<const Vector3> normals = {};
  bool are_nodes = false;  ///< the places that the nodes of a surface have in the input, in their order
  /// Smoothing lengths hold at places of mean edges; elsewhere they are as many edges.
  bool by_edges = false;
};

/// smoothing: the smoothing length in the coordinates of the net, see pull_by_smoothing(); null for Eq. 9.
inline PointTies tie_points(Net& net, const Model& model, const UntiedPoints& points,
                            std::shared_ptr<const double> smoothing, ThreadTeam& team) {
  if (!points.normals.empty()) update_directions(net, model, team);
  net.points.are_nodes = points.are_nodes;
  return {net,
          points.positions,
          points.weights,
          points.nearest,
          !smoothing        ? PointFactors()
          : points.by_edges ? pull_by_edges(std::move(smoothing))
                            : pull_by_smoothing(std::move(smoothing)),
          points.normals};
}

/// Finds the equilibrium of a shape with points that pull at it: first from its start, then repeatedly from the last
/// shape.
class WarmStartedFit {
 public:
  /// smoothing: as for tie_points().
  WarmStartedFit(Net net, const FairOptions& options, UntiedPoints points, std::shared_ptr<const double> smoothing,
                 ThreadTeam& team)
      : options_(options),
        team_(&team),
        model_(model_of(net, options, points.positions)),
        distribution_(distribution_of(net, options)),
        hierarchy_(hierarchy_of(std::move(net), *model_, distribution_, team)),
        ties_(tie_points(hierarchy_->finest(), *model_, points, smoothing, team)),
        levels_(*hierarchy_, ties_, std::move(smoothing), *model_, team) {}

  Net& net() { return hierarchy_->finest(); }

  /// From its start.
  void find(Context& context, ProgressReporter& progress, FairReport& report) {
    if (start_.empty()) {
      start_ = net().positions;
    } else {
      net().positions = start_;
      levels_.tie(hierarchy_->count() - 1);
    }
    start_from_points();
    run_equilibrium(*hierarchy_, *model_, search_task(options_), {*team_, context, progress, report},
                    net().points.empty() ? nullptr : &levels_);
  }

  /// By the paper's V-cycle.
  void cycle(Context& context, ProgressReporter& progress, FairReport& report) {
    const auto& method = std::get<MultigridMethod>(options_.method);
    run_multigrid(*hierarchy_, *model_, method, {*team_, context, progress, report},
                  net().points.empty() ? nullptr : &levels_);
  }

  /// Of a surface: from the last shape, after a small change of the points or of their pulls. Where the solver of the
  /// equilibrium finds nothing there, it begins anew from the start if or_find is set, else plain iterations follow.
  void update(Context& context, ProgressReporter& progress, FairReport& report, bool or_find) {
    const std::size_t last = hierarchy_->count() - 1;
    levels_.tie(last);
    const std::vector<Vector3> start = net().positions;
    const auto& method = std::get<EquilibriumMethod>(options_.method);
    const SolverCall call{*team_, context, progress, report};
    run_equilibrium_from_near(*hierarchy_, hierarchy_->preconditioner(last), *model_, method, call, &levels_);
    if (report.outcome == Outcome::converged || report.outcome == Outcome::cancelled) return;
    // Where ties do not change nothing else leads further.
    if (net().points.are_nodes) return;
    net().positions = start;
    levels_.tie(last);
    if (or_find) {
      find(context, progress, report);
      if (report.outcome == Outcome::converged || report.outcome == Outcome::cancelled) return;
      net().positions = start;
      levels_.tie(last);
    }
    SweepTask task{.step_tolerance = plain_tolerance, .max_iterations = plain_iterations};
    task.renew_ties = [&] { (void)levels_.renew(0); };
    const SweepResult swept = sweep_until_still(net(), *model_, task, *team_, context);
    report.outcome = swept.outcome;
    // The length of a sweep's steps does not show how far the shape is from an equilibrium.
    report.expected_error.reset();
    report.work += work_of_sweep * static_cast<double>(swept.iterations) * static_cast<double>(net().moving);
    update_directions(net(), *model_, *team_);
  }

 private:
  /// A start for curves whose nodes keep their place: a smoothing spline, as with noise as large as the edges the
  /// iteration finds nothing.
  void start_from_points() {
    if (!net().is_curve || net().target_positions.empty() || net().points.empty()) return;
    update_directions(net(), *model_, *team_);
    model_->prepare(net());
    std::vector<NodeForce> forces(net().moving);
    model_->find_forces(net(), {0, net().moving}, forces);
    std::vector<double> pull(net().moving);
    for (std::size_t i = 0; i < pull.size(); ++i) pull[i] = forces[i].stiffness;
    start_smooth(net(), pull);
    levels_.tie(hierarchy_->count() - 1);
  }

  // The last steps of a plain iteration are about k times their distance.
  static constexpr double plain_tolerance = 1e-4;
  static constexpr int plain_iterations = 300;

  const FairOptions& options_;
  ThreadTeam* team_;
  std::unique_ptr<const Model> model_;
  Distribution distribution_;
  std::unique_ptr<Hierarchy> hierarchy_;
  PointTies ties_;
  PointLevels levels_;
  std::vector<Vector3> start_;  ///< empty before find()
};

}  // namespace vspring
