// Scattered points (§4.5, indirect constraints).

#include "vspring/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/cancellation.hpp"
#include "base/stopwatch.hpp"
#include "checks/result_check.hpp"
#include "constraints/holding.hpp"
#include "constraints/slivers.hpp"
#include "equilibrium/sweep_method.hpp"
#include "fit/chains_at_one_place.hpp"
#include "fit/fit_points.hpp"
#include "fit/fit_run.hpp"
#include "fit/fit_to_tolerance.hpp"
#include "fit/fit_warnings.hpp"
#include "fit/kinds_of_fit.hpp"
#include "fit/least_bending_fit.hpp"
#include "fit/noise_fit.hpp"
#include "noise/noisy_places.hpp"
#include "noise/spikes.hpp"
#include "points/point_factors.hpp"
#include "points/point_ties.hpp"
#include "vspring/figures.hpp"

namespace vspring {

namespace {

// Turns of finding outliers, and then the shape without them.
constexpr int most_turns_of_outliers = 12;
// In standard deviations: of regular noise one node in 2,000 is as far off what is around it.
constexpr double least_off_of_spikes = 3.5;
// A shape whose nodes moved so far, root mean square, as a share of the size, and which is so many times as far from
// the points, is certainly such a balloon.
constexpr double balloon_move = 0.1;
constexpr double balloon_times = 3;
// Number of nodes and points up to which distances are still measured after a cancellation.
constexpr std::size_t most_measured_in_haste = 40'000;
// Least share of the smoothing that is asked for; and the work for trying less of it, as a multiple of the limit for
// one fit.
constexpr double least_share_of_smoothing = 1.0 / 32;
constexpr double most_work_again = 2;

template <typename Subject>
class Fitting {
 public:
  Fitting(const typename Subject::Shape& shape, const Constraints& constraints, const ScatteredPoints& points,
          const FitOptions& options, Context& context)
      : run_(shape, constraints, points, options, context), options_(options) {}

  FitResult fit() {
    const auto& shape = run_.subject.shape();
    const Constraints& constraints = run_.subject.constraints();
    if (constraints.node_count() != shape.node_count()) (void)check_constraints(shape, constraints);
    refuse_sliding(
        constraints,
        "points, or its own nodes, pull at the surface, and then only nodes of the boundary and of sharp edges "
        "can slide; let these alone do so, by a smaller region or by their numbers");
    ProgressReporter progress(run_.context);
    progress.report("preparing", 0);
    try {
      const CancellationScope cancellation(run_.context);
      if (options_.outliers > 0) {
        leave_outliers_out(progress);
      } else {
        fit(progress, false);
      }
      stay_sound();
      measure_distances();
    } catch (const Cancelled&) {
      end_early();
    }
    return std::move(run_.result);
  }

 private:
  /// With all that was finished before the run was cancelled.
  void end_early() {
    run_.result.report.fair.outcome = Outcome::cancelled;
    if (run_.result.positions.empty()) {
      run_.finish_unchanged();
      is_sound_ = true;
    }
    if (!is_sound_) stay_sound();
    measure_distances();
  }

  /// And says what follows from them.
  void measure_distances() {
    FitResult& result = run_.result;
    FitReport& report = result.report;
    report.outlying_points = left_out(run_.counted, run_.kept);
    report.outliers = static_cast<Index>(report.outlying_points.size());
    if (run_.context.cancelled()) {
      if (report.fair.outcome == Outcome::converged) report.fair.outcome = Outcome::cancelled;
      const auto size = static_cast<std::size_t>(run_.subject.shape().node_count()) + run_.points.positions.size();
      if (size > most_measured_in_haste) return;
    }
    const std::vector<double>& before = run_.subject.distances_before();
    result.distances = run_.distances();
    report.before = summary(before, run_.counting(before, run_.counted));
    const std::vector<std::uint8_t> counting = run_.counting(result.distances);
    report.after = summary(result.distances, counting);
    tell_points_at_held(run_.kept, counting, options_.tolerance(), result);
    if (options_.noise())
      warn_if_far_off(report, *options_.noise());
    else if (!options_.tolerance())
      warn_if_left_behind(report, run_.points.positions);
    if (const auto tolerance = options_.tolerance())
      report.outside_points = count_beyond(result.distances, counting, *tolerance);
    if (run_.points.positions == run_.subject.shape().positions()) measure_shape();
    if (options_.within()) report.active_points = active_points(result.distances, counting, *options_.within());
  }

  /// How far the shape is from the points, which are its own nodes, and how far these went along it.
  void measure_shape() {
    FitReport& report = run_.result.report;
    const std::vector<Vector3>& before = run_.subject.shape().positions();
    const std::vector<Vector3>& after = run_.result.positions;
    if (run_.context.cancelled()) return;
    auto moved = run_.subject.shape();
    moved.set_positions(after);
    report.shape = distance(moved, run_.subject.shape(), run_.measuring);
    for (std::size_t i = 0; i < before.size(); ++i) {
      // The square of a node's move less that of its point's distance: about that of its way along the surface.
      const double way = (after[i] - before[i]).squaredNorm() - run_.result.distances[i] * run_.result.distances[i];
      if (run_.counted[i] != 0 && way > 0) report.greatest_slide = std::max(report.greatest_slide, std::sqrt(way));
    }
  }

  /// Describes how far nodes moved, if it is far and away from the points; else empty.
  std::string balloon(const Net& before, const Net& now) {
    if (options_.tolerance() || options_.noise()) return {};
    double squares = 0;
    for (std::size_t i = 0; i < now.moving; ++i) squares += (now.positions[i] - before.positions[i]).squaredNorm();
    const double share = std::sqrt(squares / std::max<double>(1, static_cast<double>(now.moving))) / diagonal(before);
    if (!(share > balloon_move)) return {};
    const auto rms = [&](const std::vector<double>& distances) {
      return summary(distances, run_.counting(distances)).all.rms;
    };
    const double at_first = rms(run_.subject.distances_before());
    const double at_last = rms(run_.distances());
    if (!(at_last > balloon_times * at_first)) return {};
    return fmt::format(
        "its nodes are {:.2g} % of the size away from where they were, and it is {:.2g} from the points in place of "
        "{:.2g}, all in the root mean square",
        100 * share, at_last, at_first);
  }

  /// The input with its constraints, the shape that was found, and how it is worse, in words.
  struct InputAndFound {
    explicit InputAndFound(Fitting& fitting) : input(fitting.run_.gather()) {
      auto& run = fitting.run_;
      for (const Vector3& point : run.points.positions) input.points.positions.push_back(input.frame.to_local(point));
      check.emplace(input, run.team);
      input.points = {};
      found = input;
      for (std::size_t i = 0; i < input.moving; ++i)
        found.positions[i] = input.frame.to_local(run.result.positions[static_cast<std::size_t>(input.node[i])]);
      fault = check->fault(found);
      if (fault.empty()) fault = run.subject.crossings(run.result.positions, run.context);
      if (fault.empty()) fault = fitting.balloon(input, found);
    }

    Net input;
    std::optional<ResultCheck> check;
    Net found;
    std::string fault;
  };

  /// Warnings of a shape that is not handed out.
  static void forget_what_was_found(FairReport& report) {
    std::erase_if(report.warnings, [](const Warning& warning) {
      return warning.code == WarningCode::no_equilibrium || warning.code == WarningCode::other_fairness ||
             warning.code == WarningCode::outside_tolerance || warning.code == WarningCode::maybe_not_fairest;
    });
  }

  /// Keeps the input where the result is worse, unless the options accept that.
  void stay_sound() {
    FairReport& report = run_.result.report.fair;
    is_sound_ = report.outcome == Outcome::worse_than_input || (run_.context.cancelled() && run_.is_unchanged());
    if (is_sound_) return;
    const InputAndFound shapes(*this);
    is_sound_ = true;
    const std::string& fault = shapes.fault;
    if (fault.empty()) return;
    const bool input_is_faulty = !shapes.check->fault_of_places(shapes.input).empty();
    const bool is_accepted =
        options_.fair.accept_worse || (input_is_faulty && shapes.check->misplaced(shapes.found).empty());
    if (!is_accepted) {
      run_.finish(shapes.input);
      forget_what_was_found(report);
    }
    if (report.outcome != Outcome::cancelled) report.outcome = Outcome::worse_than_input;
    report.warnings.push_back(
        {WarningCode::worse_than_input,
         is_accepted
             ? "what was found is worse than the input: " + fault
             : fmt::format("what was found is worse than the input ({}): this is the input with its constraints; "
                           "try other weights or tolerances, or hold more",
                           fault)});
  }

  /// How far away a point is that may be an outlier. distances: of all points; counting: 1 for those that count.
  [[nodiscard]] double least_of_outliers(const std::vector<double>& distances,
                                         const std::vector<std::uint8_t>& counting) const {
    std::vector<double> of_counting;
    for (std::size_t j = 0; j < distances.size(); ++j) {
      if (counting[j] != 0) of_counting.push_back(distances[j]);
    }
    if (of_counting.empty()) return 0;
    const auto middle = of_counting.begin() + static_cast<std::ptrdiff_t>(of_counting.size() / 2);
    std::nth_element(of_counting.begin(), middle, of_counting.end());
    const double least = outlying * *middle / median_of_noise;
    return options_.within() ? std::min(least, *options_.within()) : least;
  }

  /// Leaves out nodes that are off what is around them.
  void leave_spikes_out() {
    if constexpr (std::is_same_v<Subject, FitSurface>) {
      const PolygonMesh& mesh = run_.subject.shape();
      std::vector<std::uint8_t> candidates = run_.counted;
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (run_.subject.constraints().position_fixed(static_cast<Index>(i))) candidates[i] = 0;
      }
      const double deviation = options_.noise() ? *options_.noise() : noise_of_moving_nodes(run_).deviation;
      const auto most = static_cast<std::size_t>(options_.outliers * static_cast<double>(mesh.node_count()));
      const auto spikes = spikes_of(mesh, candidates, deviation, least_off_of_spikes, most, run_.team);
      for (std::size_t i = 0; i < spikes.size(); ++i) {
        if (spikes[i] != 0) run_.kept[i] = 0;
      }
    }
  }

  /// Fits without outliers. A surface's own nodes are known to be some beforehand; else the points that are furthest
  /// away are left out, in turns, until they stay the same.
  void leave_outliers_out(ProgressReporter& progress) {
    if (run_.points_are_nodes()) {
      leave_spikes_out();
      fit(progress, false);
      return;
    }
    const bool searches = options_.tolerance().has_value();
    // As long as outliers count, no tolerance can be met.
    bool smooth_first = searches;
    for (int turn = 0; turn < most_turns_of_outliers; ++turn) {
      fit(progress, smooth_first);
      if (run_.context.cancelled()) return;
      std::vector<double> distances = run_.distances();
      const std::vector<std::uint8_t> counting = run_.counting(distances, run_.counted);
      for (std::size_t j = 0; j < distances.size(); ++j) distances[j] *= counting[j];
      std::vector<std::uint8_t> kept =
          without_furthest(distances, options_.outliers, least_of_outliers(distances, counting));
      for (std::size_t j = 0; j < kept.size(); ++j) kept[j] *= run_.counted[j];
      const auto before = std::exchange(run_.kept, std::move(kept));
      if (before != run_.kept) continue;
      if (!smooth_first) return;
      smooth_first = false;
    }
    if (smooth_first) fit(progress, false);
    run_.result.report.fair.warnings.push_back(
        {WarningCode::outliers_changed, "the outliers went on changing with the shape: the last ones are left out"});
  }

  /// smooth: by some edges, instead of to a tolerance.
  void fit(ProgressReporter& progress, bool smooth) {
    run_.start(options_.fair.method_kind());
    FairReport& report = run_.result.report.fair;
    UntiedPoints points = run_.untied_points();
    const auto has_weight = [](double weight) { return weight > 0; };
    if (std::none_of(points.weights.begin(), points.weights.end(), has_weight)) {
      FairResult plain = vspring::fair(run_.subject.shape(), run_.subject.constraints(), options_.fair, run_.context);
      report = std::move(plain.report);
      run_.result.positions = std::move(plain.positions);
      return;
    }
    std::vector<std::uint8_t> pulled(static_cast<std::size_t>(run_.subject.shape().node_count()), 0);
    for (std::size_t j = 0; j < points.nearest.size(); ++j) {
      if (points.nearest[j] >= 0 && has_weight(points.weights[j]))
        pulled[static_cast<std::size_t>(points.nearest[j])] = 1;
    }
    const std::vector<Warning> warnings = run_.subject.check(pulled);
    report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
    if (const auto* const method = std::get_if<SweepMethod>(&options_.fair.method)) {
      sweep(std::move(points), *method, progress);
      return;
    }
    if (report.method == Method::multigrid) {
      run_on_levels(std::move(points), progress);
      return;
    }
    if constexpr (std::is_same_v<Subject, FitSurface>) {
      if (options_.noise()) {
        fit_without_noise(run_, std::move(points), progress);
        return;
      }
      if (options_.rms() && fit_to_rms_by_filters(run_, points, progress)) return;
      if (options_.within() && fit_within_by_filters(run_, points, smooth, progress)) return;
      if (options_.tolerance()) {
        FitToTolerance(run_).fit(points, progress, smooth);
        return;
      }
    }
    if constexpr (std::is_same_v<Subject, FitSurface>) {
      run_on_levels(points, progress);
      const bool found = report.outcome == Outcome::converged || report.outcome == Outcome::cancelled;
      if (!found && run_.may_be_another()) bend_less(points, progress);
    } else {
      run_on_levels(std::move(points), progress);
    }
  }

  /// By equilibrium or multigrid.
  void run_on_levels(UntiedPoints points, ProgressReporter& progress) {
    Net net = run_.gather_start();
    const auto smoothing = smoothing_in(net);
    WarmStartedFit shape(std::move(net), options_.fair, std::move(points), smoothing, run_.team);
    FairReport& report = run_.result.report.fair;
    if (report.method == Method::multigrid)
      shape.cycle(run_.context, progress, report);
    else
      shape.find(run_.context, progress, report);
    run_.finish(shape.net());
  }

  /// Finds the shape of least bending near the points, where springs and points of a surface have no equilibrium.
  void bend_less(const UntiedPoints& points, ProgressReporter& progress) {
    FairReport& report = run_.result.report.fair;
    Net net = run_.subject.gather(true);
    const auto smoothing = smoothing_in(net);
    LeastBendingFit shape(std::move(net), options_.fair, points, smoothing, run_.team);
    // As much again.
    shape.go(run_.context, progress, report, report.most_work);
    report.most_work += report.most_work;
    run_.finish(shape.net());
    if (report.outcome == Outcome::converged)
      warn_of_least_bending(report);
    else if (report.outcome != Outcome::cancelled)
      report.warnings.push_back(
          {WarningCode::no_equilibrium,
           fmt::format("no equilibrium was found: this is the input, bent less and drawn to the points, {}; noise may "
                       "have folded faces",
                       distance_from_equilibrium(report)),
           {{Remedy::smoothing_length, "smooth by more or less"}, {Remedy::noise, "only take its noise off"}}});
  }

  void sweep(UntiedPoints points, const SweepMethod& method, ProgressReporter& progress) {
    Net net = run_.gather_start();
    const auto model = model_of(net, options_.fair, points.positions);
    set_laplacian_weights(net, *model, distribution_of(net, options_.fair), run_.team);
    const auto smoothing = smoothing_in(net);
    PointTies ties = tie_points(net, *model, points, smoothing, run_.team);
    points = {};
    std::function<void()> renew_ties;
    if (!net.points.empty()) renew_ties = [&] { (void)ties.renew(run_.team); };
    run_sweeps(net, *model, method, {run_.team, run_.context, progress, run_.result.report.fair}, renew_ties);
    run_.finish(net);
  }

  std::shared_ptr<double> smoothing_in(const Net& net) {
    if (!options_.smoothing_length()) return nullptr;
    run_.result.report.smoothing_length = options_.smoothing_length();
    return std::make_shared<double>(*options_.smoothing_length() * net.frame.scale());
  }

  FitRun<Subject> run_;
  const FitOptions& options_;
  bool is_sound_ = false;  ///< the result, as stay_sound() leaves it
};

template <typename Subject>
FitResult fit_shape(const typename Subject::Shape& shape, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context) {
  options.validate();
  check_points(points, shape.positions());
  return Fitting<Subject>(shape, constraints, points, options, context).fit();
}

FitResult fit_curve_to_points(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                              const FitOptions& options, Context& context) {
  if (constraints.corner_count() > 0) return fit_curve(curve, constraints, points, options, context);
  const auto* const method = std::get_if<EquilibriumMethod>(&options.fair.method);
  const bool has_free_end = std::any_of(curve.chains().begin(), curve.chains().end(), [&](const auto& chain) {
    return !chain.closed && !chain.nodes.empty() && constraints.node_count() == curve.node_count() &&
           (!constraints.position_fixed(chain.nodes.front()) || !constraints.position_fixed(chain.nodes.back()));
  });
  // Springs would draw them in.
  if (has_free_end && !method) (void)check_constraints(curve, constraints);
  const bool has_nodes_of_its_own = options.tolerance() || options.noise() || !options.moves_freely() ||
                                    options.least_radius > 0 || options.sharp > 0 || !options.fair.corners.empty();
  // Outliers are found before nodes go anywhere.
  if (has_nodes_of_its_own || ((has_free_end || options.outliers > 0) && method))
    return fit_curve(curve, constraints, points, options, context);
  FitResult balanced = fit_shape<FitCurve>(curve, constraints, points, options, context);
  const Outcome outcome = balanced.report.fair.outcome;
  const bool is_found = outcome == Outcome::converged || outcome == Outcome::cancelled;
  if (is_found || !may_be_another(options)) return balanced;
  // Springs that keep the shares of edges have no equilibrium where edges are shorter than the noise.
  FitResult drawn = fit_curve(curve, constraints, points, options, context);
  return drawn.report.fair.outcome == Outcome::converged ? drawn : balanced;
}

/// As fit_as_asked(); where that finds nothing that is no worse than the input, with half of the smoothing length (16
/// times the weight), a quarter and so on.
FitResult fit_or_smooth_less(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                             const FitOptions& options, Context& context) {
  FitResult found = fit_as_asked(mesh, constraints, points, options, context);
  const Outcome outcome = found.report.fair.outcome;
  const bool is_found = outcome == Outcome::converged || outcome == Outcome::cancelled;
  if (is_found || !may_be_another(options) || !(options.weight().value_or(0) > 0 || options.smoothing_length()))
    return found;
  double work = 0;
  for (double share = 0.5; share >= least_share_of_smoothing && work <= most_work_again * found.report.fair.most_work;
       share /= 2) {
    FitOptions less = options;
    if (options.weight())
      less.criterion = Weight{std::min(largest_weight, *options.weight() * std::pow(share, -4))};
    else
      less.criterion = SmoothingLength{*options.smoothing_length() * share};
    FitResult nearer = fit_as_asked(mesh, constraints, points, less, context);
    if (context.cancelled()) {
      found.report.fair.outcome = Outcome::cancelled;
      return found;
    }
    work += nearer.report.fair.work;
    if (nearer.report.fair.outcome != Outcome::converged) continue;
    const char* const why = outcome == Outcome::worse_than_input ? "what it leads to is worse than the input"
                                                                 : "springs and points find no balance";
    nearer.report.fair.warnings.push_back(
        {WarningCode::smoothed_less,
         options.weight()
             ? fmt::format("the weight {:g} is too small here, as {}: this is the shape with {:g}", *options.weight(),
                           why, *less.weight())
             : fmt::format("the smoothing length {:g} is too great here, as {}: this is the shape with {:g}",
                           *options.smoothing_length(), why, *less.smoothing_length())});
    return nearer;
  }
  return found;
}

FitResult fit_surface(const PolygonMesh& given, const Constraints& constraints, const ScatteredPoints& points,
                      const FitOptions& options, Context& context) {
  if (!options.fair.sharp_edges.empty()) return fit_sharp_sides(given, constraints, points, options, context);
  const bool to_equilibrium = std::holds_alternative<EquilibriumMethod>(options.fair.method);
  const PolygonMesh mesh = to_equilibrium ? Slivers(given).left_out(constraints) : given;
  if (!options.moves_freely())
    throw Error(ErrorCode::invalid_argument, "coordinates can be kept on curves only",
                {{Remedy::moving_axes, "let all of them move"}});
  if (options.voxels()) {
    options.validate();
    return fit_voxels(mesh, constraints, points, options, context);
  }
  return fit_or_smooth_less(mesh, constraints, points, options, context);
}

/// Calls fit(), and has the report say how long that took in all.
template <typename Fit>
FitResult timed(Fit fit) {
  const Stopwatch stopwatch;
  FitResult result = fit();
  result.report.fair.seconds = stopwatch.seconds();
  return result;
}

}  // namespace

FitResult fit_as_asked(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                       const FitOptions& options, Context& context) {
  return fit_sheets(mesh, constraints, points, options, context,
                    [&](const PolygonMesh& sheets, const Constraints& held, const ScatteredPoints& of_sheets) {
                      if (!options.fair.fair_boundary && !slides_at_boundary(sheets, held))
                        return fit_shape<FitSurface>(sheets, held, of_sheets, options, context);
                      options.validate();
                      check_points(of_sheets, sheets.positions());
                      return fit_boundary_first(sheets, held, of_sheets, options, context);
                    });
}

FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options, Context& context) {
  return timed([&] { return fit_surface(mesh, constraints, points, options, context); });
}

FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options) {
  Context context;
  return fit(mesh, constraints, points, options, context);
}

FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options, Context& context) {
  options.validate();
  if (options.voxels()) throw Error(ErrorCode::invalid_argument, "curves have no voxels; take a smoothing length");
  check_points(points, curve.positions());
  check_corners_kept(options, constraints);
  return timed([&] {
    const ChainsAtOnePlace places(curve, constraints);
    return places.complete(points,
                           [&] { return fit_curve_to_points(places.rest(), places.held(), points, options, context); });
  });
}

FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options) {
  Context context;
  return fit(curve, constraints, points, options, context);
}

}  // namespace vspring
