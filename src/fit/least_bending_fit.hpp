#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "equilibrium/bending_descent.hpp"
#include "fit/warm_started_fit.hpp"
#include "points/face_ties.hpp"

namespace vspring {

/// A surface that bends least near points that pull at it, where these and springs find no balance.
class LeastBendingFit {
 public:
  /// net: for spheres, see gather_net(). smoothing: as for tie_points(). mesh: that of the net, if points are to pull
  /// by their distances from its faces; null: by those from the tangent planes of their nodes.
  LeastBendingFit(Net net, const FairOptions& options, const UntiedPoints& points,
                  std::shared_ptr<const double> smoothing, ThreadTeam& team, const PolygonMesh* mesh = nullptr)
      : net_(std::move(net)),
        tolerance_(std::get<EquilibriumMethod>(options.method).tolerance * diagonal(net_)),
        model_(model_of(net_, options)),
        ties_(tie_points(net_, *model_, points, std::move(smoothing), team)),
        team_(&team) {
    if (mesh) face_ties_.emplace(*mesh, net_);
  }

  Net& net() { return net_; }

  /// From the last shape, by steps that bend it less. most_work: as in FairReport. bounds: as in EquilibriumTask.
  void go(Context& context, ProgressReporter& progress, FairReport& report, double most_work,
          const PointBounds& bounds = {}) {
    const auto nodes = static_cast<double>(net_.moving);
    const double size = diagonal(net_);
    EquilibriumTask task;
    task.tolerance = tolerance_;
    task.most_work = most_work / nodes;
    task.renew_ties = [&](double margin) { return ties_.renew(*team_, margin); };
    task.face_ties = face_ties_ ? &*face_ties_ : nullptr;
    task.bounds = bounds;
    task.may_smooth_start = !has_begun_;
    has_begun_ = has_begun_ || face_ties_;
    task.on_iteration = [&](double expected) {
      report.history.push_back(expected / size);
      progress.report("fairing", 0.5, static_cast<int>(report.history.size()), expected / size);
    };
    const EquilibriumResult found = descend_bending(net_, *model_, task, *team_, context);
    report.outcome = found.outcome == Outcome::iteration_limit ? Outcome::work_limit : found.outcome;
    report.iterations += found.iterations;
    report.work += found.work * nodes;
    report.expected_error = report.residual = found.expected_error / size;
    report.springs = Springs::sphere;
    report.fair_by = FairBy::bending;
    report.levels.push_back({.moving_nodes = static_cast<Index>(net_.moving),
                             .iterations = found.iterations,
                             .outcome = report.outcome,
                             .strategy = "less bending",
                             .kept_nodes = static_cast<Index>(found.kept)});
  }

 private:
  Net net_;
  double tolerance_;
  std::unique_ptr<const Model> model_;
  PointTies ties_;
  ThreadTeam* team_;
  std::optional<FaceTies> face_ties_;
  bool has_begun_ = false;
};

}  // namespace vspring
