#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "equilibrium/account.hpp"
#include "fit/fit_run.hpp"
#include "fit/interior_fit.hpp"
#include "fit/tolerance_fit.hpp"
#include "points/point_factors.hpp"
#include "vspring/error.hpp"

namespace vspring {

/// A fit of a surface by Within or RootMeanSquare.
class FitToTolerance {
 public:
  explicit FitToTolerance(FitRun<FitSurface>& run) : run_(run), tolerance_(*run.options.tolerance()) {}

  /// Then that is the fairest, and the result. in_few_steps: whole scans have no equilibrium, and take long to show it.
  bool plain_fairing_is_within(FairOptions options, bool in_few_steps) {
    if (in_few_steps) {
      auto& limit = std::get<EquilibriumMethod>(options.method).max_iterations;
      limit = std::min(limit.value_or(few_steps), few_steps);
    }
    try {
      (void)run_.subject.check({});
    } catch (const Error&) {
      // Only points hold it.
      return false;
    }
    FairResult plain = vspring::fair(run_.subject.shape(), run_.subject.constraints(), options, run_.context);
    if (plain.report.outcome != Outcome::converged && !run_.context.cancelled()) return false;
    if (!run_.context.cancelled() && !is_within(plain.positions)) return false;
    run_.result.positions = std::move(plain.positions);
    run_.result.report.fair = std::move(plain.report);
    return true;
  }

  /// only_smooth: by some edges, instead of to the tolerance.
  void fit(UntiedPoints points, ProgressReporter& progress, bool only_smooth) {
    if (!only_smooth && plain_fairing_is_within(run_.options.fair, points.are_nodes)) return;
    FitReport& report = run_.result.report;
    Context& context = run_.context;
    Net net = run_.gather_start();
    const double scale = net.frame.scale();
    const double edge = mean_edge(net);
    const auto length = std::make_shared<double>(edge);
    FairOptions options = run_.options.fair;
    auto& method = std::get<EquilibriumMethod>(options.method);
    method.tolerance = std::min(method.tolerance, precision * tolerance_ * scale / diagonal(net));
    WarmStartedFit shape(std::move(net), options, std::move(points), length, run_.team);
    // Long lengths bridge what is noise; short ones leave a start that is near its points as it is.
    const auto nodes = static_cast<double>(shape.net().moving);
    const double most_work = std::max(least_most_work, most_work_a_node * nodes);
    const auto& lengths = shape.net().target_positions.empty() ? first_lengths : first_lengths_in_place;
    for (const double first : lengths) {
      *length = first * edge;
      shape.find(context, progress, report.fair);
      if (report.fair.outcome == Outcome::converged || context.cancelled()) break;
    }
    if (!method.max_iterations) report.fair.most_work = most_work;
    const auto finish_with = [&](double found) {
      run_.finish(shape.net());
      report.smoothing_length = found / scale;
    };
    if (only_smooth || context.cancelled()) {
      finish_with(*length);
      return;
    }
    // Of the last equilibrium that was found.
    std::optional<double> last_error;
    if (report.fair.outcome == Outcome::converged) last_error = report.fair.expected_error;
    ToleranceFitTask task;
    task.net = &shape.net();
    task.length = length;
    task.found = report.fair.outcome == Outcome::converged;
    task.update = [&](bool or_find) {
      FairReport one;
      shape.update(context, progress, one, or_find);
      report.fair.iterations += one.iterations;
      report.fair.work += one.work;
      report.fair.history.insert(report.fair.history.end(), one.history.begin(), one.history.end());
      report.fair.residual = one.residual;
      report.fair.expected_error = one.expected_error;
      report.fair.outcome = one.outcome;
      if (one.outcome == Outcome::converged && one.expected_error) last_error = one.expected_error;
      return one.outcome == Outcome::converged;
    };
    task.ended = [&] {
      return context.cancelled() || (report.fair.most_work > 0 && report.fair.work >= report.fair.most_work);
    };
    std::vector<Vector3> measured;
    task.measure = [&] {
      measured = run_.positions_of(shape.net());
      std::vector<double> all = run_.subject.distances(measured);
      for (std::size_t j = 0; j < all.size(); ++j) all[j] = run_.kept[j] != 0 ? all[j] * scale : 0;
      return all;
    };
    task.energy = [&] { return run_.subject.fairness(measured).vspring_energy; };
    ToleranceFitResult found =
        run_.options.within() ? fit_within(task, tolerance_ * scale) : smooth(task, tolerance_ * scale);
    // Tries that led nowhere tell nothing of the shape that is kept.
    found.settled = found.settled && last_error;
    if (found.settled) {
      report.fair.residual = *last_error;
      report.fair.expected_error = last_error;
    }
    finish_with(found.length);
    conclude(found);
  }

 private:
  // On each level.
  static constexpr int few_steps = 20;
  // The smoothing lengths that tolerances are looked for from, in mean edges.
  static constexpr std::array<double, 4> first_lengths = {3, 1, 0.3, 0.1};
  // The same where nodes keep their place, and whose details may be few edges wide.
  static constexpr std::array<double, 4> first_lengths_in_place = {1, 1.4, 2, 0.7};
  // What may be done for one tolerance, in iterations of one moving node: as much as for four equilibria.
  static constexpr double least_most_work = 1.35e6;
  static constexpr double most_work_a_node = 1800;
  // Of a tolerance.
  static constexpr double room = 0.8;
  static constexpr double any_start = 0.5;
  // Of a tolerance, to which equilibria are found.
  static constexpr double precision = 1e-3;

  /// tolerance: in the coordinates of the net.
  ToleranceFitResult smooth(const ToleranceFitTask& task, double tolerance) const {
    return smooth_within(task, tolerance, [&](const std::vector<double>& all) { return figure_of(all); });
  }

  /// By the interior-point method, from a smooth shape that leaves it room. Where that finds nothing, by Lawson's
  /// algorithm.
  ToleranceFitResult fit_within(ToleranceFitTask& task, double tolerance) const {
    Net& net = *task.net;
    const double close_share = task.close_share;
    {
      task.close_share = any_start;
      task.takes_nearest = true;
      const ToleranceFitResult start = smooth(task, room * tolerance);
      if (task.ended()) return start;
      const std::vector<Vector3> places = net.positions;
      const ToleranceFitResult found = hold_between(task, tolerance, start);
      if (found.settled || task.ended()) return found;
      if (found.within) return hold_within(task, tolerance, found);
      net.positions = places;
      *task.length = start.length;
    }
    task.close_share = close_share;
    task.takes_nearest = false;
    const ToleranceFitResult start = smooth(task, tolerance);
    return task.ended() ? start : hold_within(task, tolerance, start);
  }

  /// What is to be within the tolerance. distances: 0 for points left out.
  [[nodiscard]] double figure_of(const std::vector<double>& distances) const {
    double greatest = 0;
    double squares = 0;
    double count = 0;
    for (std::size_t j = 0; j < distances.size(); ++j) {
      greatest = std::max(greatest, distances[j]);
      squares += distances[j] * distances[j];
      count += run_.kept[j];
    }
    return run_.options.within() ? greatest : std::sqrt(squares / count);
  }

  /// By the points that count.
  [[nodiscard]] bool is_within(const std::vector<Vector3>& positions) {
    std::vector<double> all = run_.subject.distances(positions);
    for (std::size_t j = 0; j < all.size(); ++j) all[j] *= run_.kept[j];
    return figure_of(all) <= tolerance_;
  }

  void conclude(const ToleranceFitResult& found) {
    FairReport& fair = run_.result.report.fair;
    if (run_.context.cancelled()) {
      fair.outcome = Outcome::cancelled;
      return;
    }
    const Outcome limit = fair.most_work > 0 ? Outcome::work_limit : Outcome::iteration_limit;
    fair.outcome = found.settled ? Outcome::converged : found.within ? limit : Outcome::stalled;
    if (!found.within && is_within(run_.result.positions))
      fair.warnings.push_back(
          {WarningCode::no_equilibrium,
           "the shape is within the tolerance, but no equilibrium was found there: more that is held, or other "
           "tolerances, "
           "may do"});
    else if (!found.within)
      fair.warnings.push_back(
          {WarningCode::outside_tolerance,
           fmt::format(
               "no shape of this mesh was found within {:g}: this is the one that comes nearest; points may lie "
               "at what is held, or edges may be too long",
               tolerance_)});
    else if (!found.settled)
      fair.warnings.push_back(
          {WarningCode::maybe_not_fairest, "the shape is within the tolerance, but may not be the fairest that is"});
  }

  FitRun<FitSurface>& run_;
  double tolerance_;
};

}  // namespace vspring
