// A fair curve with nodes of its own is drawn to the points; then the nodes of the result are put on it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "base/cancellation.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "curve_fit/curve_lengths.hpp"
#include "fairness/curve_runs.hpp"
#include "fit/chains_at_one_place.hpp"
#include "fit/curve_fit_input.hpp"
#include "fit/curve_fit_report.hpp"
#include "fit/curve_measures.hpp"
#include "fit/finished_nodes.hpp"
#include "fit/fit_points.hpp"
#include "fit/found_nodes.hpp"
#include "fit/kinds_of_fit.hpp"
#include "fit/profile.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

/// Between two nodes at one place there is no curvature.
bool has_equal_rows(const PolygonCurve& curve) {
  const std::vector<CurveRun> runs = curve_runs(curve, nullptr);
  return std::any_of(runs.begin(), runs.end(), [](const CurveRun& run) { return run.zero_length_edges > 0; });
}

// In tolerances: how far points may be from the chords so that the curve is still drawn nearer, in all and for one
// point.
constexpr double most_cut_off = 1.2;
constexpr double most_spared = 0.7;
// As a share of the allowed root mean square.
constexpr double well_used = 0.7;
constexpr int most_turns_nearer = 5;
// A right angle: a fair curve turns by less in all than a smoothing spline that is as near to the points.
constexpr double most_new_turn = std::numbers::pi / 2;
// Nodes times steps of programs, of all attempts: some seconds. Of ordinary logs 99 of 100 take less than a tenth.
constexpr std::size_t least_work = 5'000'000;
constexpr std::size_t work_of_row = 500;

/// Of all edges, in radians.
double turn_of(const DenseCurve& curve) {
  return total_turn(curve, [&](std::uint32_t node) -> const Vector3& { return curve.place(node); });
}

class CurveFit {
 public:
  CurveFit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
           const FitOptions& options, Context& context)
      : input_(curve, constraints, points, options, context),
        context_(context),
        progress_(context),
        measures_(input_, fitted_.found, context.threads) {}

  /// The result of fair(), where that is within the tolerance: then nothing pulls.
  std::optional<FitResult> plain_fairing() {
    const FitOptions& options = input_.options();
    // What keeps corners holds them where their points are.
    if (!options.tolerance() || options.outliers > 0 || !options.moves_freely() || has_equal_rows(input_.curve()) ||
        has_corners(options, input_.constraints()))
      return std::nullopt;
    FairResult plain;
    try {
      (void)check_constraints(input_.curve(), input_.constraints());
      plain = fair(input_.curve(), input_.constraints(), options.fair, context_);
    } catch (const Error&) {
      // Only points hold it.
      return std::nullopt;
    }
    // The shape of least bending near the input is no result for a tolerance.
    if (plain.report.outcome != Outcome::converged || plain.report.fair_by != FairBy::curvature) return std::nullopt;
    const Resampled own{input_.curve(), input_.constraints(), {}};
    PolygonCurve moved = input_.curve();
    moved.set_positions(plain.positions);
    if (measures_.figure(measures_.distances(moved)) > *options.tolerance() ||
        measures_.radius_kept(measures_.sharpest(moved, own)) < 1)
      return std::nullopt;
    FitResult result = this->result(std::move(plain.positions), own);
    result.report.fair = std::move(plain.report);
    result.report.pulling_points = result.report.pulled_nodes = result.report.most_points = 0;
    return result;
  }

  struct Attempt : MeasuredNodes {
    CurveFound found;
  };

  template <typename Put>
  Attempt attempt(CurveFound found, Put put) {
    fitted_.found = std::move(found);
    const FitOptions& options = input_.options();
    const Distribution given = options.fair.distribution.value_or(Distribution::even);
    MeasuredNodes nodes = measures_.measured(put(given));
    // Few nodes that are even cut off a nose.
    if (!options.fair.distribution && !input_.own_nodes() && options.tolerance() &&
        nodes.figure > *options.tolerance()) {
      MeasuredNodes as_came = measures_.measured(put(Distribution::smooth));
      if (as_came.figure < nodes.figure && as_came.new_folds <= nodes.new_folds) nodes = std::move(as_came);
    }
    return {std::move(nodes), std::move(fitted_.found)};
  }

  template <typename Put>
  Attempt attempt_with(const CurveFound& spline, Put put) {
    Attempt smooth = attempt(spline, put);
    smooth.found.converged = true;
    return smooth;
  }

  /// Finds the curve by change of curvature in proportion to itself, and by that alike everywhere, and takes the fairer
  /// one. spline: where noise has chosen the tolerance, a smooth curve as far from the points, which is taken where the
  /// other ones fold: with rows much denser than their noise many curves are near enough. put(spacing) makes the nodes
  /// of the result on it. False where that was cancelled.
  template <typename Put>
  bool find(const CurveFound* spline, Put put) {
    progress_.report("preparing", 0);
    const CancellationScope cancellation(context_);
    std::optional<Attempt> best;
    try {
      if (input_.options().outliers > 0) input_.leave_outliers_out();
      CurveFitTask task = input_.task();
      task.most_work = least_work + work_of_row * input_.points().positions.size();
      const auto tolerance = input_.options().tolerance();
      // Where chords cut off too much, the curve is held nearer; where it is bent too much between its own nodes, to a
      // larger radius.
      CurveFound start;
      for (int turn = 0; turn < most_turns_nearer; ++turn) {
        std::optional<Attempt> now;
        if (tolerance && (turn == 0 || input_.options().rms())) {
          start = start_of(task);
          task.start = &start;
        }
        for (const bool evenly : {false, true}) {
          if (evenly && (!tolerance || task.most_work == 0)) break;
          task.evenly = evenly;
          const auto report = [&](double share) { progress_.report("curve", (share + task.evenly) / 2); };
          Attempt attempt = this->attempt(vspring::fit_curve(task, report), put);
          task.most_work -= std::min(task.most_work, attempt.found.work);
          if (!now || is_better(attempt, *now)) now = std::move(attempt);
        }
        const bool ends = !leave_room(*now, task) || task.most_work == 0;
        if (!best || is_nearer(*now, *best)) best = std::move(now);
        if (ends) break;
      }
    } catch (const Cancelled&) {
    }
    if (!best) return false;
    if (spline != nullptr) {
      fitted_.leeway = most_cut_off;
      if (folds_more(*best, *spline)) {
        Attempt smooth = attempt_with(*spline, put);
        const bool is_near = smooth.figure <= fitted_.leeway * *input_.options().tolerance();
        if (is_near && smooth.new_folds <= best->new_folds) best = std::move(smooth);
      }
    }
    fitted_.found = std::move(best->found);
    FinishedNodes(input_, measures_, fitted_.found, context_).finish(*best);
    // Rows that are off are named though a curve goes through them.
    if ((!fitted_.found.converged || input_.own_nodes()) && input_.options().outliers == 0) name_outliers();
    keep(*std::move(best));
    return true;
  }

  /// Takes a spline as it is, whose distance from the points is the tolerance.
  template <typename Put>
  void take(const CurveFound& spline, Put put) {
    Attempt smooth = attempt_with(spline, put);
    fitted_.leeway = std::numeric_limits<double>::infinity();
    fitted_.found = std::move(smooth.found);
    keep(std::move(smooth));
  }

  /// positions: of the file's nodes or of new ones.
  [[nodiscard]] FitResult result(std::vector<Vector3> positions, const Resampled& nodes) const {
    return result_of(input_, measures_, fitted_, std::move(positions), nodes, context_);
  }

  /// Whether the input stays, as what was found is folded.
  [[nodiscard]] bool keeps_input() const { return fitted_.new_folds > 0 && !input_.options().fair.accept_worse; }

  /// Those that were found.
  [[nodiscard]] const Resampled& nodes() const { return fitted_.nodes; }

  [[nodiscard]] const CurveFitInput& input() const { return input_; }

  /// The curve itself.
  [[nodiscard]] const CurveFound& found() const { return fitted_.found; }

 private:
  void keep(MeasuredNodes found) {
    fitted_.way_beyond = found.way_beyond;
    fitted_.new_folds = found.new_folds;
    fitted_.nodes = std::move(found.nodes);
  }

  [[nodiscard]] static bool folds_more(const Attempt& attempt, const CurveFound& spline) {
    return attempt.new_folds > 0 || turn_of(attempt.found.curve) > turn_of(spline.curve) + most_new_turn;
  }

  /// Possible reasons why there is no fair curve, or one with a spike.
  void name_outliers() {
    try {
      const CancellationScope cancellation(context_);
      input_.name_outliers();
    } catch (const Cancelled&) {
    }
  }

  /// Without new folds, near the polyline of the points and within the tolerance first, then with fewer inflections,
  /// fewer extremes of curvature, less variation.
  [[nodiscard]] bool is_better(const Attempt& a, const Attempt& b) const {
    if ((a.new_folds > 0) != (b.new_folds > 0)) return b.new_folds > 0;
    const double tolerance = *input_.options().tolerance();
    // A curve a little beyond the root mean square is drawn nearer afterwards.
    const double near = (input_.options().rms() ? most_cut_off : 1) * tolerance;
    const bool within = a.figure <= near;
    const double furthest = (input_.options().rms() ? reach_of_rms : 1) * tolerance;
    const double most = far_off_way * std::max(furthest, std::min(a.way_off, b.way_off));
    if ((a.way_off <= most) != (b.way_off <= most)) return a.way_off <= most;
    if (a.found.converged != b.found.converged) return a.found.converged;
    if (within != (b.figure <= near)) return within;
    // At tips a curve may stay nearer than the wanted distance, however small the weight of points.
    const double least = input_.options().rms() ? well_used * tolerance : 0;
    if ((a.figure >= least) != (b.figure >= least)) return a.figure >= least;
    if (a.radius_kept != b.radius_kept) return a.radius_kept > b.radius_kept;
    if (a.figures.inflections != b.figures.inflections) return a.figures.inflections < b.figures.inflections;
    if (a.figures.curvature_extrema != b.figures.curvature_extrema)
      return a.figures.curvature_extrema < b.figures.curvature_extrema;
    return a.figures.curvature_variation < b.figures.curvature_variation;
  }

  /// Of attempts one after the other: whether it has fewer new folds, or as many and less of it is beyond the
  /// tolerance, or as much and it is less sharp.
  [[nodiscard]] bool is_nearer(const MeasuredNodes& a, const MeasuredNodes& b) const {
    const double least = input_.options().tolerance().value_or(std::numeric_limits<double>::infinity());
    const double beyond = std::max(a.figure, least);
    const double other = std::max(b.figure, least);
    return std::tuple(a.new_folds, beyond, b.radius_kept) < std::tuple(b.new_folds, other, a.radius_kept);
  }

  /// Tightens the task for another attempt, by how far this one is beyond its limits. False where it is not, or too
  /// far.
  bool leave_room(const MeasuredNodes& attempt, CurveFitTask& task) const {
    const bool is_sharp = attempt.radius_kept < 1 && attempt.radius_kept * most_cut_off >= 1;
    if (is_sharp) task.least_radius /= share_of_nearer * attempt.radius_kept;
    const auto tolerance = input_.options().tolerance();
    if (!tolerance || attempt.figure <= *tolerance) return is_sharp;
    if (!input_.options().within()) {
      task.rms *= share_of_nearer * *tolerance / attempt.figure;
      return attempt.figure <= most_cut_off * *tolerance;
    }
    if (attempt.way_beyond > most_cut_off) return false;
    if (attempt.way_beyond > 1) task.way_share *= share_of_nearer / attempt.way_beyond;
    const std::vector<double> distances = measures_.movable_distances(attempt.nodes);
    task.spare.resize(distances.size(), 0);
    for (std::size_t j = 0; j < distances.size(); ++j) {
      if (input_.kept()[j] == 0 || distances[j] <= *tolerance) continue;
      task.spare[j] += (distances[j] - share_of_nearer * *tolerance) * input_.scale();
      if (task.spare[j] > most_spared * task.within) return false;
    }
    return true;
  }

  CurveFitInput input_;
  Context& context_;
  ProgressReporter progress_;
  FittedCurve fitted_;
  CurveMeasures measures_;
};

/// A fit with the root mean square that noise leaves in place of its deviation, and the smoothing spline that tells it.
struct FitOfNoise {
  FitOptions options;
  std::optional<CurveFound> spline;

  [[nodiscard]] const CurveFound* spline_or_none() const { return spline ? &*spline : nullptr; }
};

FitOfNoise fit_of_noise(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                        const FitOptions& options, Context& context) {
  FitOfNoise found{options, {}};
  found.options.criterion = RootMeanSquare{*options.noise()};
  CurveFitInput input(curve, constraints, points, options, context);
  if (!input.pulls()) return found;
  try {
    const CancellationScope cancellation(context);
    if (options.outliers > 0) input.leave_outliers_out();
    CurveFound least = curve_of_least_risk(input.task());
    const double rms = least.rms / input.scale();
    if (!(rms > 0)) return found;
    found.options.criterion = RootMeanSquare{rms};
    found.spline = std::move(least);
  } catch (const Cancelled&) {
  }
  return found;
}

/// As they came, where they are held.
std::vector<Vector3> unchanged(const CurveFitInput& input) {
  std::vector<Vector3> positions = input.curve().positions();
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = input.place(static_cast<Index>(i));
  return positions;
}

ResampledFit fit_chains_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                                  const FitOptions& options, Context& context) {
  const bool has_nodes_of_its_own = !options.weight() || options.least_radius > 0 || has_corners(options, constraints);
  if (options.fair.method_kind() == Method::equilibrium && has_nodes_of_its_own)
    return fit_curve_resampled(curve, constraints, how, options, context);
  ResampledFit made{resample(curve, constraints, how), {}};
  made.fit = fit(made.resampled.curve, made.resampled.constraints, {.positions = curve.positions()}, options, context);
  return made;
}

/// Makes the file's nodes the result: on the curve, if that is found and no worse than the input.
FitResult with_own_nodes(const CurveFit& run, bool is_found) {
  const CurveFitInput& input = run.input();
  const PolygonCurve& curve = input.curve();
  const Constraints& constraints = input.constraints();
  const double strength = input.options().fair.strength;
  std::vector<Vector3> positions = unchanged(input);
  if (is_found && !run.keeps_input()) {
    positions = run.nodes().curve.positions();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (strength < 1 && !constraints.position_fixed(static_cast<Index>(i)))
        positions[i] = curve.positions()[i] + strength * (positions[i] - curve.positions()[i]);
    }
  }
  FitResult result = run.result(std::move(positions), {curve, constraints, {}});
  FairReport& fair = result.report.fair;
  double squares = 0;
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    if (constraints.position_fixed(static_cast<Index>(i))) continue;
    const double move = (result.positions[i] - curve.positions()[i]).norm();
    fair.greatest_move = std::max(fair.greatest_move, move);
    squares += move * move;
  }
  fair.rms_move = std::sqrt(squares / std::max<double>(1, fair.moving_nodes));
  return result;
}

/// spline: see CurveFit::find().
FitResult fit_from(const CurveFound* spline, const PolygonCurve& curve, const Constraints& constraints,
                   const ScatteredPoints& points, const FitOptions& options, Context& context) {
  const Stopwatch stopwatch;
  CurveFit run(curve, constraints, points, options, context);
  if (!run.input().pulls()) {
    FairResult plain = fair(curve, constraints, options.fair, context);
    FitResult result = run.result(std::move(plain.positions), {curve, constraints, {}});
    result.report.fair = std::move(plain.report);
    return result;
  }
  if (auto plain = run.plain_fairing()) return *std::move(plain);
  const bool is_found =
      run.find(spline, [&](Distribution spacing) { return own_nodes(run.input(), run.found(), spacing); });
  FitResult result = with_own_nodes(run, is_found);
  result.report.fair.seconds = stopwatch.seconds();
  return result;
}

ResampledFit fit_resampled_from(const CurveFound* spline, const PolygonCurve& curve, const Constraints& constraints,
                                const Resampling& how, const FitOptions& options, Context& context) {
  const Stopwatch stopwatch;
  ResampledFit made{resample(curve, constraints, how), {}};
  const ScatteredPoints points{.positions = curve.positions()};
  CurveFit run(curve, constraints, points, options, context);
  if (run.input().pulls() && run.find(spline, [&](Distribution) { return new_nodes(run.input(), run.found(), how); }))
    made.resampled = run.nodes();
  made.fit = run.result(made.resampled.curve.positions(), made.resampled);
  FairReport& fair = made.fit.report.fair;
  const Distance moves = distance(made.fit.positions, curve);
  fair.greatest_move = moves.greatest;
  fair.rms_move = moves.rms;
  fair.seconds = stopwatch.seconds();
  return made;
}

}  // namespace

FitResult fit_curve(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context) {
  if (Profile::is_needed(curve, constraints, options)) {
    const Profile profile(curve, constraints, options);
    FitResult result =
        fit_curve(profile.curve(), profile.constraints(),
                  {.positions = profile.curve().positions(), .weights = points.weights}, profile.options(), context);
    result.positions = profile.lifted(result.positions);
    return result;
  }
  if (!options.noise()) return fit_from(nullptr, curve, constraints, points, options, context);
  const FitOfNoise noise = fit_of_noise(curve, constraints, points, options, context);
  FitResult result = fit_from(noise.spline_or_none(), curve, constraints, points, noise.options, context);
  result.report.noise_leaves = noise.options.rms();
  return result;
}

FitResult smooth_curve(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                       const FitOptions& options, Context& context) {
  const ChainsAtOnePlace places(curve, constraints);
  return places.complete(points, [&] {
    const FitOfNoise noise = fit_of_noise(places.rest(), places.held(), points, options, context);
    if (!noise.spline) return fit_from(nullptr, places.rest(), places.held(), points, noise.options, context);
    CurveFit run(places.rest(), places.held(), points, noise.options, context);
    run.take(*noise.spline, [&](Distribution spacing) { return own_nodes(run.input(), run.found(), spacing); });
    return with_own_nodes(run, true);
  });
}

ResampledFit fit_curve_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                                 const FitOptions& options, Context& context) {
  if (Profile::is_needed(curve, constraints, options)) {
    const Profile profile(curve, constraints, options);
    ResampledFit made = fit_curve_resampled(profile.curve(), profile.constraints(), how, profile.options(), context);
    profile.lift(made);
    return made;
  }
  if (!options.noise()) return fit_resampled_from(nullptr, curve, constraints, how, options, context);
  const FitOfNoise noise = fit_of_noise(curve, constraints, {.positions = curve.positions()}, options, context);
  ResampledFit made = fit_resampled_from(noise.spline_or_none(), curve, constraints, how, noise.options, context);
  made.fit.report.noise_leaves = noise.options.rms();
  return made;
}

ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                           const FitOptions& options, Context& context) {
  options.validate();
  const ChainsAtOnePlace places(curve, constraints);
  ResampledFit made = places.are_all()
                          ? places.unchanged_nodes()
                          : fit_chains_resampled(places.rest(), places.held(), places.for_rest(how), options, context);
  places.add_to(made);
  return made;
}

ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                           const FitOptions& options) {
  Context context;
  return fit_resampled(curve, constraints, how, options, context);
}

}  // namespace vspring
