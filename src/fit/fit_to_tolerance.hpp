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
#include "fit/bend_within.hpp"
#include "fit/fit_run.hpp"
#include "fit/fit_warnings.hpp"
#include "fit/interior_fit.hpp"
#include "fit/least_bending_fit.hpp"
#include "fit/tolerance_fit.hpp"
#include "points/point_factors.hpp"
#include "vspring/error.hpp"

namespace vspring {

/// A fit of a surface by Within or RootMeanSquare.
class FitToTolerance {
 public:
  explicit FitToTolerance(FitRun<FitSurface>& run) : run_(run), tolerance_(*run.options.tolerance()) {}

  /// Then that is the fairest shape, and the result. in_few_steps: whole scans have no equilibrium, and it takes long
  /// to find that out.
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
  void fit(const UntiedPoints& points, ProgressReporter& progress, bool only_smooth) {
    if (!only_smooth && plain_fairing_is_within(run_.options.fair, points.are_nodes)) return;
    FitReport& report = run_.result.report;
    Context& context = run_.context;
    Net net = run_.gather_start();
    const double edge = mean_edge(net);
    const auto length = std::make_shared<double>(edge);
    const FairOptions options = precise_options(net);
    // Then springs mostly have no equilibrium with other lengths either, and it takes long to find that out.
    const bool only_points_hold = net.moving == net.node.size() && !points.are_nodes && run_.may_be_another();
    WarmStartedFit shape(std::move(net), options, points, length, run_.team);
    // Long lengths smooth noise; short ones hardly change a start that is near its points.
    const bool is_free = shape.net().target_positions.empty() && !only_points_hold;
    const auto& lengths = is_free ? first_lengths : first_lengths_in_place;
    for (const double first : lengths) {
      *length = first * edge;
      shape.find(context, progress, report.fair);
      if (report.fair.outcome == Outcome::converged || context.cancelled()) break;
      if (only_points_hold) break;
    }
    const double most_work = std::max(least_most_work, most_work_a_node * static_cast<double>(shape.net().moving));
    if (!options.max_iterations()) report.fair.most_work = most_work;
    const bool is_found = report.fair.outcome == Outcome::converged;
    if (only_smooth && only_points_hold && !is_found && !context.cancelled()) {
      LeastBendingFit bent(run_.subject.gather(true), options, points, length, run_.team, &run_.subject.shape());
      FairReport one;
      bent.go(context, progress, one, most_work);
      account(one);
      finish_with(bent.net(), *length);
      return;
    }
    if (only_smooth || context.cancelled()) {
      finish_with(shape.net(), *length);
      return;
    }
    ToleranceFitResult found;
    if (is_found || !only_points_hold) {
      found = search(shape.net(), length,
                     [&](FairReport& one, bool or_find) { shape.update(context, progress, one, or_find); });
      finish_with(shape.net(), found.length);
      // Least bending measures distances from faces: it may be within the tolerance where springs are not.
      const bool is_done = found.settled || (found.within && !some_were_lost_);
      if (is_done || !run_.may_be_another() || context.cancelled()) {
        conclude(found);
        return;
      }
    }
    report.fair.most_work = report.fair.work + most_work;
    conclude(bend_less(points, points.are_nodes ? first_lengths_in_place.back() : 1, progress, found));
  }

 private:
  // On each level.
  static constexpr int few_steps = 20;
  // The smoothing lengths from which the search for a tolerance begins, in mean edges.
  static constexpr std::array<double, 4> first_lengths = {3, 1, 0.3, 0.1};
  // The same where nodes keep their place, and whose details may be few edges wide.
  static constexpr std::array<double, 4> first_lengths_in_place = {1, 1.4, 2, 0.7};
  // The limit of work for one tolerance, in iterations of one moving node: as for four equilibria.
  static constexpr double least_most_work = 1.35e6;
  static constexpr double most_work_a_node = 1800;
  // As shares of a tolerance.
  static constexpr double room = 0.8;
  static constexpr double any_start = 0.5;
  // As a share of the way back to the start.
  static constexpr double least_step_back = 0.01;
  // The precision of equilibria, as a share of a tolerance.
  static constexpr double precision = 1e-3;
  static constexpr double precision_of_bending = 0.02;

  [[nodiscard]] FairOptions precise_options(const Net& net, double share = precision) const {
    FairOptions options = run_.options.fair;
    auto& method = std::get<EquilibriumMethod>(options.method);
    method.tolerance = std::min(method.tolerance, share * tolerance_ * net.frame.scale() / diagonal(net));
    return options;
  }

  /// length: 0 where points do not pull by one.
  void finish_with(const Net& net, double length) {
    run_.finish(net);
    run_.result.report.smoothing_length = length > 0 ? std::optional(length / net.frame.scale()) : std::nullopt;
  }

  /// Begins with the shape of the net. update(report, or_find): as `follow` in the task; the report has its outcome.
  template <typename Update>
  ToleranceFitResult search(Net& net, const std::shared_ptr<double>& length, const Update& update) {
    FairReport& fair = run_.result.report.fair;
    // Of the last equilibrium that was found.
    std::optional<double> last_error;
    const auto look = [&] {
      const bool is_found = fair.outcome == Outcome::converged;
      if (is_found && fair.expected_error) last_error = fair.expected_error;
      some_were_lost_ = some_were_lost_ || !is_found;
      return is_found;
    };
    const double scale = net.frame.scale();
    ToleranceFitTask task;
    task.net = &net;
    task.length = length;
    task.found = look();
    task.update = [&](bool or_find) {
      FairReport one;
      update(one, or_find);
      account(one);
      return look();
    };
    task.ended = [&] { return has_ended(); };
    std::vector<Vector3> measured;
    task.measure = [&] {
      measured = run_.positions_of(net);
      std::vector<double> all = run_.subject.distances(measured);
      counting_ = run_.counting(all);
      for (std::size_t j = 0; j < all.size(); ++j) all[j] = counting_[j] != 0 ? all[j] * scale : 0;
      return all;
    };
    task.energy = [&] { return run_.subject.fairness(measured).vspring_energy; };
    ToleranceFitResult found =
        run_.options.within() ? fit_within(task, tolerance_ * scale) : smooth(task, tolerance_ * scale);
    // Attempts that found nothing say nothing about the shape that is kept.
    found.settled = found.settled && last_error;
    if (found.settled) {
      fair.residual = *last_error;
      fair.expected_error = last_error;
    }
    return found;
  }

  [[nodiscard]] bool has_ended() const {
    const FairReport& fair = run_.result.report.fair;
    return run_.context.cancelled() || (fair.most_work > 0 && fair.work >= fair.most_work);
  }

  /// One of many runs.
  void account(const FairReport& one) {
    FairReport& fair = run_.result.report.fair;
    fair.iterations += one.iterations;
    fair.work += one.work;
    fair.history.insert(fair.history.end(), one.history.begin(), one.history.end());
    fair.residual = one.residual;
    fair.expected_error = one.expected_error;
    fair.outcome = one.outcome;
  }

  /// The same with shapes of least bending, where springs and points have no equilibrium. The result is the better one
  /// of that and the shape by springs.
  ToleranceFitResult bend_less(const UntiedPoints& points, double first_length, ProgressReporter& progress,
                               const ToleranceFitResult& by_springs) {
    FairReport& fair = run_.result.report.fair;
    const double residual = fair.residual;
    const std::optional<double> expected_error = fair.expected_error;
    const bool within = run_.options.within().has_value();
    Net net = run_.subject.gather(true);
    const auto length = std::make_shared<double>(first_length * mean_edge(net));
    const FairOptions options = precise_options(net, precision_of_bending);
    LeastBendingFit shape(std::move(net), options, points, length, run_.team, &run_.subject.shape());
    FairReport last;
    const auto descend = [&](const PointBounds& bounds) {
      last = {};
      shape.go(run_.context, progress, last, fair.most_work - fair.work, bounds);
      account(last);
    };
    ToleranceFitResult found;
    if (within) {
      found = bend_within({.net = &shape.net(),
                           .distance = tolerance_ * shape.net().frame.scale(),
                           .descend = descend,
                           .furthest = [&] { return figure_at(run_.positions_of(shape.net())) / tolerance_; },
                           .ended = [&] { return has_ended(); }},
                          run_.team);
    } else {
      descend({});
      found = search(shape.net(), length, [&](FairReport& one, bool /*or_find*/) {
        shape.go(run_.context, progress, one, fair.most_work - fair.work);
      });
    }
    const std::vector<Vector3> positions = run_.positions_of(shape.net());
    const bool is_better =
        run_.result.positions.empty() ||
        (found.within ? !by_springs.within || is_fairer(positions, run_.result.positions)
                      : !by_springs.within && figure_at(positions) < figure_at(run_.result.positions));
    if (!is_better) {
      fair.residual = residual;
      fair.expected_error = expected_error;
      return by_springs;
    }
    fair.springs = last.springs;
    fair.fair_by = last.fair_by;
    fair.levels.insert(fair.levels.end(), last.levels.begin(), last.levels.end());
    // Which of all these shapes kept how many nodes is not known.
    fair.levels.back().kept_nodes = 0;
    finish_with(shape.net(), found.length);
    warn_of_least_bending(fair);
    return found;
  }

  /// tolerance: in the coordinates of the net.
  ToleranceFitResult smooth(const ToleranceFitTask& task, double tolerance) const {
    return smooth_within(task, tolerance, [&](const std::vector<double>& all) { return figure_of(all, counting_); });
  }

  /// By the interior-point method, from a smooth shape well within the tolerance.
  ToleranceFitResult fit_within(ToleranceFitTask task, double tolerance) const {
    task.close_share = any_start;
    task.takes_nearest = true;
    const ToleranceFitResult start = smooth(task, room * tolerance);
    return task.ended() ? start : hold_between(task, tolerance, start);
  }

  /// What is to be within the tolerance.
  [[nodiscard]] double figure_of(const std::vector<double>& distances,
                                 const std::vector<std::uint8_t>& counting) const {
    double greatest = 0;
    double squares = 0;
    double count = 0;
    for (std::size_t j = 0; j < distances.size(); ++j) {
      if (counting[j] == 0) continue;
      greatest = std::max(greatest, distances[j]);
      squares += distances[j] * distances[j];
      count += 1;
    }
    return run_.options.within() ? greatest : std::sqrt(squares / count);
  }

  [[nodiscard]] double figure_at(const std::vector<Vector3>& positions) {
    const std::vector<double> all = run_.subject.distances(positions);
    return figure_of(all, run_.counting(all));
  }

  [[nodiscard]] bool is_within(const std::vector<Vector3>& positions) { return figure_at(positions) <= tolerance_; }

  void conclude(const ToleranceFitResult& found) {
    FairReport& fair = run_.result.report.fair;
    if (run_.context.cancelled()) {
      fair.outcome = Outcome::cancelled;
      return;
    }
    if (found.settled) {
      fair.outcome = Outcome::converged;
      return;
    }
    const bool starts_within = is_within(start());
    const bool within = found.within || (starts_within && go_back());
    if (starts_within && !(within && is_fairer(run_.result.positions, start()))) {
      run_.finish_unchanged();
      fair.outcome = Outcome::worse_than_input;
      fair.warnings.push_back({WarningCode::worse_than_input,
                               "nothing fairer was found within the tolerance: this is the input with its constraints; "
                               "try a greater tolerance, or hold more"});
      return;
    }
    if (!within && figure_at(start()) < figure_at(run_.result.positions)) {
      run_.finish_unchanged();
      fair.outcome = Outcome::worse_than_input;
      fair.warnings.push_back(
          {WarningCode::worse_than_input,
           fmt::format(
               "no shape of this mesh was found within {:g}, nor any that is nearer than the input: this is the "
               "input with its constraints",
               tolerance_),
           {{Remedy::within, "allow more"}}});
      return;
    }
    fair.outcome = within ? Outcome::converged : Outcome::stalled;
    // How far it is from an equilibrium is not known.
    fair.expected_error.reset();
    if (within)
      fair.warnings.push_back(
          {WarningCode::maybe_not_fairest, "the shape is within the tolerance, but may not be the fairest one"});
    else if (is_within(run_.result.positions))
      fair.warnings.push_back(
          {WarningCode::no_equilibrium,
           "the shape is within the tolerance, but no equilibrium was found there: hold more, or try "
           "other tolerances"});
    else
      fair.warnings.push_back(
          {WarningCode::outside_tolerance,
           fmt::format("no shape of this mesh was found within {:g}: this is the nearest; points may lie "
                       "near what is held, or edges may be too long",
                       tolerance_)});
  }

  [[nodiscard]] std::vector<Vector3> start() const {
    return positions_as_held(run_.subject.shape().positions(), run_.subject.constraints());
  }

  /// Goes from the shape that was found towards the start, which is within the tolerance, until it is, too. False where
  /// only the start itself is.
  bool go_back() {
    const std::vector<Vector3> start = this->start();
    const std::vector<Vector3> found = run_.result.positions;
    std::vector<Vector3> best = start;
    double inside = 0;
    for (double step = 0.5; step > least_step_back; step /= 2) {
      std::vector<Vector3> between = start;
      for (std::size_t i = 0; i < between.size(); ++i) between[i] += (inside + step) * (found[i] - start[i]);
      if (!is_within(between)) continue;
      inside += step;
      best = std::move(between);
    }
    Net net = run_.gather();
    for (std::size_t i = 0; i < net.moving; ++i)
      net.positions[i] = net.frame.to_local(best[static_cast<std::size_t>(net.node[i])]);
    run_.finish(net);
    return inside > 0;
  }

  /// By its springs.
  [[nodiscard]] bool is_fairer(const std::vector<Vector3>& positions, const std::vector<Vector3>& than) const {
    return run_.subject.fairness(positions).vspring_energy < run_.subject.fairness(than).vspring_energy;
  }

  FitRun<FitSurface>& run_;
  double tolerance_;
  std::vector<std::uint8_t> counting_;  ///< of every point, when it was measured last; 1 where it counts
  bool some_were_lost_ = false;         ///< shapes on the way that were no equilibria
};

}  // namespace vspring
