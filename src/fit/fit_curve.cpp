// A fair curve is drawn to the points, with nodes of its own; then the nodes that are wanted are put on it.

#include "fit/fit_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "base/cancellation.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "constraints/sides.hpp"
#include "fit/curve_fit_input.hpp"
#include "fit/curve_measures.hpp"
#include "fit/fit_points.hpp"
#include "fit/fit_warnings.hpp"
#include "fit/found_nodes.hpp"
#include "fit/profile.hpp"
#include "vspring/error.hpp"
#include "vspring/figures.hpp"

namespace vspring {

namespace {

// Of the edge before or after.
constexpr double sparse_share = 0.05;
// Of the tolerance, or of how far another curve is from the polyline of the points.
constexpr double far_off_way = 2;
// Of the tolerance: what chords may cut off for the curve to be drawn nearer, in all and at one point, and how near.
constexpr double most_cut_off = 1.2;
constexpr double most_spared = 0.7;
constexpr double share_of_nearer = 0.997;
// Of a root mean square that is allowed.
constexpr double well_used = 0.7;
// How far the furthest point of a curve may be, in root mean squares of all.
constexpr double furthest_of_rms = 3;
constexpr int most_turns_nearer = 5;
constexpr int most_turns_of_chords = 4;
constexpr int most_turns_of_pulling = 8;
// Of how far places may be from the polyline: where steps are done, and what is reported as too far.
constexpr double next_to_nothing_beyond = 1.001;
constexpr double little_beyond = 1.1;

class CurveFit {
 public:
  CurveFit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
           const FitOptions& options, Context& context)
      : input_(curve, constraints, points, options, context),
        context_(context),
        progress_(context),
        measures_(input_, found_, context.threads) {}

  /// The result of fair(), where that is within the tolerance: then nothing pulls.
  std::optional<FitResult> plain_fairing() {
    const FitOptions& options = input_.options();
    // What keeps corners holds them where their points are.
    if (!options.tolerance() || options.outliers > 0 || !options.moves_freely() ||
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
    if (plain.report.outcome != Outcome::converged) return std::nullopt;
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
  Attempt attempt(const CurveFitTask& task, Put put) {
    found_ = vspring::fit_curve(task, [&](double share) { progress_.report("curve", (share + task.evenly) / 2); });
    MeasuredNodes nodes = measures_.measured(put());
    return {std::move(nodes), std::move(found_)};
  }

  /// Tells nodes of their places on the curve that was found, which goes by change of curvature in proportion to
  /// itself, and by that alike everywhere; the fairer one is taken. False where that was cancelled.
  template <typename Put>
  bool find(Put put) {
    progress_.report("preparing", 0);
    const CancellationScope cancellation(context_);
    std::optional<Attempt> best;
    try {
      if (input_.options().outliers > 0) input_.leave_outliers_out();
      CurveFitTask task = input_.task();
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
          if (evenly && !tolerance) break;
          task.evenly = evenly;
          Attempt attempt = this->attempt(task, put);
          if (!now || is_better(attempt, *now)) now = std::move(attempt);
        }
        const bool ends = !leave_room(*now, task);
        if (!best || is_nearer(*now, *best)) best = std::move(now);
        if (ends) break;
      }
    } catch (const Cancelled&) {
    }
    if (!best) return false;
    found_ = std::move(best->found);
    for (int turn = 0; turn < most_turns_of_chords && draw_chords_in(*best); ++turn) {
    }
    pull_to_rows(*best);
    keep_what_is_fairer(*best);
    way_beyond_ = best->way_beyond;
    nodes_ = std::move(best->nodes);
    return true;
  }

  /// Those that were found.
  [[nodiscard]] const Resampled& nodes() const { return nodes_; }

  [[nodiscard]] const CurveFitInput& input() const { return input_; }

  /// The curve itself.
  [[nodiscard]] const CurveFound& found() const { return found_; }

  /// Nodes that are far apart cut off what the curve does between them: where that is more than the tolerance allows
  /// for, they go to where their chords are within it. False where they do not. Elsewhere too, if these are fairer
  /// then, as where a table is coarse.
  bool draw_chords_in(MeasuredNodes& before, bool were_pulled = false) {
    const auto tolerance = input_.options().tolerance();
    const bool are_new = !before.nodes.from.empty();
    // At a station of its own no node is cut off.
    if (!tolerance || context_.cancelled() || (!are_new && input_.moving() != Vector3::Ones())) return false;
    if (before.figure <= *tolerance && !were_pulled && !(input_.options().within() && are_sparse(before.nodes.curve)))
      return false;
    const DenseCurve chords = measures_.chords(before.nodes.curve, before.nodes);
    CurveFitTask task = input_.task();
    task.nodes = &chords;
    task.evenly = true;
    task.scattered = found_.points;
    // Nodes that are the points keep the way between them.
    task.keeps_way = are_new;
    carry_places(found_.curve, chords, task.scattered);
    const CurveFound drawn = vspring::fit_curve(task, [](double) {});
    Resampled moved = before.nodes;
    std::vector<Vector3> places = moved.curve.positions();
    for (std::uint32_t i = 0; i < drawn.curve.size(); ++i) {
      const auto& node = drawn.curve.node(i);
      if (!node.held) places[static_cast<std::size_t>(node.from)] = input_.to_input(node.place);
    }
    moved.curve.set_positions(std::move(places));
    MeasuredNodes after = measures_.measured(std::move(moved));
    // Points may be near a curve that goes anywhere between them.
    const bool stays =
        after.way_off <= far_off_way * std::max(before.way_off, *tolerance) && after.radius_kept >= before.radius_kept;
    const bool fairer = were_pulled ? after.figures.curvature_variation < before.figures.curvature_variation
                                    : is_fairer(after.figures, before.figures);
    const bool better = before.figure > *tolerance
                            ? after.figure < before.figure
                            : fairer && after.figure <= *tolerance && drawn.beyond <= next_to_nothing_beyond;
    if (!better || !stays) return false;
    if (were_pulled) found_.converged = drawn.converged;
    before = std::move(after);
    return true;
  }

  /// Rows are within any tolerance of themselves: where the curve is not of some, their nodes go to where they are, and
  /// from there to where their chords are fairest. At last all nodes do; chords are within then, too.
  void pull_to_rows(MeasuredNodes& found) {
    const auto within = input_.options().within();
    if (!within || !input_.own_nodes() || !found.nodes.from.empty()) return;
    const auto points_off = [&](const Resampled& nodes) {
      return measures_.figure(measures_.movable_distances(nodes));
    };
    if (points_off(found.nodes) <= *within) return;
    MeasuredNodes now = found;
    for (int turn = 1; turn <= most_turns_of_pulling && now.figure > *within; ++turn) {
      std::vector<Vector3> places = now.nodes.curve.positions();
      const std::vector<double> distances = measures_.movable_distances(now.nodes);
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (input_.kept()[i] == 0 || input_.constraints().position_fixed(static_cast<Index>(i))) continue;
        const Vector3 row = input_.curve().position(static_cast<Index>(i));
        const double away = turn < most_turns_of_pulling ? distances[i] : (places[i] - row).norm();
        if (away > *within) places[i] = row + share_of_nearer * *within * (places[i] - row).normalized();
      }
      Resampled pulled = now.nodes;
      pulled.curve.set_positions(std::move(places));
      now = measures_.measured(std::move(pulled));
      // Between rows in their own order, whatever the way's is.
      if (turn == most_turns_of_pulling) now.figure = points_off(now.nodes);
    }
    if (!(now.figure < found.figure)) return;
    if (now.figure <= *within) now.way_beyond = 0;
    found = std::move(now);
    found_.converged = false;
    (void)draw_chords_in(found, true);
  }

  /// The rows themselves, which are within any tolerance, where the curve that was found is no fairer.
  void keep_what_is_fairer(MeasuredNodes& found) {
    const Constraints& constraints = input_.constraints();
    const FitOptions& options = input_.options();
    if (!input_.own_nodes() || !found.nodes.from.empty() || !options.tolerance()) return;
    if (options.fair.distribution.value_or(Distribution::even) == Distribution::even) return;
    for (Index i = 0; i < input_.curve().node_count(); ++i) {
      const bool free = tangents_given(constraints, i) == 0 && !constraints.normal_fixed(i);
      if (!free || input_.kept()[static_cast<std::size_t>(i)] != input_.counted()[static_cast<std::size_t>(i)]) return;
      if (constraints.position_fixed(i) && constraints.position(i) != input_.curve().position(i)) return;
    }
    MeasuredNodes rows = measures_.measured({input_.curve(), constraints, {}});
    // The polyline is they themselves, in their own order.
    rows.way_beyond = 0;
    // A shape that may not be the fairest is not to vary more than what came.
    const bool varies_less = rows.figures.curvature_variation < found.figures.curvature_variation;
    if (rows.radius_kept == 1 && (found_.converged ? is_fairer(rows.figures, found.figures) : varies_less))
      found = std::move(rows);
  }

  /// positions: of the file's nodes or of new ones.
  FitResult result(std::vector<Vector3> positions, const Resampled& nodes) {
    const PolygonCurve& shape = nodes.curve;
    const Constraints& constraints = nodes.constraints;
    FitResult result;
    FitReport& report = result.report;
    FairReport& fair = report.fair;
    fair.method = Method::equilibrium;
    fair.threads = context_.thread_count();
    fair.warnings = input_.warnings();
    fair.iterations = found_.steps;
    fair.nodes = shape.node_count();
    for (Index i = 0; i < fair.nodes; ++i) {
      ++(constraints.position_fixed(i) ? fair.fixed_positions : fair.moving_nodes);
      fair.fixed_normals += constraints.normal_fixed(i) ? 1 : 0;
      fair.fixed_tangents += tangents_given(constraints, i);
    }
    result.positions = std::move(positions);
    PolygonCurve moved = shape;
    moved.set_positions(result.positions);
    const auto& kept = input_.kept();
    result.distances = measures_.distances(moved);
    report.before = summary(measures_.distances(input_.curve()), input_.counted());
    report.after = summary(result.distances, kept);
    report.shape = measures_.way_off(moved);
    if (input_.own_nodes() && nodes_.from.empty()) report.greatest_slide = measures_.greatest_slide(moved);
    report.points = static_cast<Index>(std::count(input_.counted().begin(), input_.counted().end(), 1));
    report.outliers = report.points - static_cast<Index>(std::count(kept.begin(), kept.end(), 1));
    report.pulling_points = input_.pulling_points();
    report.pulled_nodes = input_.pulled_nodes();
    report.most_points = input_.most_points();
    const std::vector<std::uint8_t> corners = measures_.corners(nodes);
    fair.corners = static_cast<Index>(std::count(corners.begin(), corners.end(), 1));
    conclude(result, measures_.sharpest(moved, nodes));
    return result;
  }

 private:
  /// Near the polyline of the points and within the tolerance first, then with fewer inflections, fewer extremes of
  /// curvature, less variation.
  [[nodiscard]] bool is_better(const Attempt& a, const Attempt& b) const {
    const double tolerance = *input_.options().tolerance();
    // What is a little beyond a root mean square is drawn nearer afterwards.
    const double near = (input_.options().rms() ? most_cut_off : 1) * tolerance;
    const bool within = a.figure <= near;
    const double furthest = (input_.options().rms() ? furthest_of_rms : 1) * tolerance;
    const double most = far_off_way * std::max(furthest, std::min(a.way_off, b.way_off));
    if ((a.way_off <= most) != (b.way_off <= most)) return a.way_off <= most;
    if (a.found.converged != b.found.converged) return a.found.converged;
    if (within != (b.figure <= near)) return within;
    // At tips one may go out to a smaller distance than is asked for, however little points weigh.
    const double least = input_.options().rms() ? well_used * tolerance : 0;
    if ((a.figure >= least) != (b.figure >= least)) return a.figure >= least;
    if (a.radius_kept != b.radius_kept) return a.radius_kept > b.radius_kept;
    if (a.figures.inflections != b.figures.inflections) return a.figures.inflections < b.figures.inflections;
    if (a.figures.curvature_extrema != b.figures.curvature_extrema)
      return a.figures.curvature_extrema < b.figures.curvature_extrema;
    return a.figures.curvature_variation < b.figures.curvature_variation;
  }

  [[nodiscard]] static bool is_fairer(const CurveFigures& a, const CurveFigures& b) {
    return a.curvature_variation < b.curvature_variation && a.curvature_extrema <= b.curvature_extrema &&
           a.inflections <= b.inflections;
  }

  /// Of attempts one after the other: whether less of it is beyond the tolerance, or as much and it is less sharp.
  [[nodiscard]] bool is_nearer(const MeasuredNodes& a, const MeasuredNodes& b) const {
    const double least = input_.options().tolerance().value_or(std::numeric_limits<double>::infinity());
    const double beyond = std::max(a.figure, least);
    const double other = std::max(b.figure, least);
    return beyond < other || (beyond == other && a.radius_kept > b.radius_kept);
  }

  /// For what is beyond, in another attempt. False where nothing is, or so much that there is no room.
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

  /// Whether no edge is much shorter than those about it, and none shorter than the tolerance.
  [[nodiscard]] bool are_sparse(const PolygonCurve& curve) const {
    for (const auto& chain : curve.chains()) {
      const std::size_t count = chain.nodes.size();
      double before = 0;
      for (std::size_t k = 0; k + 1 < count + (chain.closed ? 1 : 0); ++k) {
        const double edge = (curve.position(chain.nodes[(k + 1) % count]) - curve.position(chain.nodes[k])).norm();
        if (edge < *input_.options().within() || edge < sparse_share * before ||
            before < sparse_share * edge * (k > 0 ? 1 : 0))
          return false;
        before = edge;
      }
    }
    return true;
  }

  void conclude(FitResult& result, const SharpestNode& most_bent) const {
    FitReport& report = result.report;
    FairReport& fair = report.fair;
    if (most_bent.node >= 0) {
      report.least_radius = most_bent.radius;
      report.sharpest_node = most_bent.node;
    }
    if (context_.cancelled()) {
      fair.outcome = Outcome::cancelled;
      return;
    }
    fair.outcome = found_.converged ? Outcome::converged : Outcome::work_limit;
    // Where steps no longer make it fairer the last one tells nothing of how far it is.
    const double tolerance_of_places = std::get<EquilibriumMethod>(input_.options().fair.method).tolerance;
    if (!found_.converged || found_.error <= tolerance_of_places) fair.expected_error = found_.error;
    fair.residual = found_.error;
    fair.levels.push_back({.moving_nodes = static_cast<Index>(found_.curve.size()),
                           .iterations = found_.steps,
                           .outcome = fair.outcome,
                           .strategy = "curve through points",
                           .seconds = 0});
    const auto& options = input_.options();
    const auto tolerance = options.tolerance();
    const bool is_sharp = measures_.radius_kept(most_bent) < 1;
    if (is_sharp) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back(
          {WarningCode::radius_not_kept,
           fmt::format(
               "no shape was found that is nowhere bent by a radius of less than {:g}: this one is by {:.4g} at "
               "node {}; draw it less closely there, hold less, or allow a smaller radius",
               options.least_radius, most_bent.radius, most_bent.node)});
    }
    if (!tolerance) {
      report.smoothing_length = found_.smoothing / input_.scale();
      warn_if_left_behind(report, input_.points().positions);
      return;
    }
    const auto& kept = input_.kept();
    for (std::size_t j = 0; j < kept.size(); ++j)
      report.outside_points += kept[j] != 0 && result.distances[j] > *tolerance ? 1 : 0;
    if (options.within()) report.active_points = active_points(result.distances, kept, *tolerance);
    if (measures_.figure(result.distances) > *tolerance) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back({WarningCode::outside_tolerance, outside(result, *tolerance)});
    } else if (way_beyond_ > little_beyond) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back(
          {WarningCode::outside_tolerance,
           fmt::format("all points are within {:g} of the shape, but it goes {:.4g} away from the line through them; "
                       "put the rows in order, leave out what is off, or allow more",
                       *tolerance, report.shape.greatest)});
    } else if (!found_.converged && !is_sharp) {
      fair.warnings.push_back(
          {WarningCode::maybe_not_fairest, "the shape is within the tolerance, but may not be the fairest"});
    }
  }

  /// What is told of points that are further off than the tolerance.
  [[nodiscard]] std::string outside(const FitResult& result, double tolerance) const {
    if (!input_.options().within())
      return fmt::format(
          "no shape within {:g} was found: this is the nearest; points lie at what is held, or edges "
          "are too long",
          tolerance);
    std::vector<double> distances = result.distances;
    for (std::size_t j = 0; j < distances.size(); ++j) distances[j] *= input_.kept()[j];
    const auto point =
        static_cast<std::size_t>(std::max_element(distances.begin(), distances.end()) - distances.begin());
    return fmt::format("no shape within {:g} was found: this is the nearest; point {} is {:.4g} away{}", tolerance,
                       point, distances[point],
                       measures_.is_at_held(point, distances[point], nodes_)
                           ? ", and nearest to a node that is held: do not hold that, or allow more"
                           : ": edges are too long there, or what is held is near");
  }

  CurveFitInput input_;
  Context& context_;
  ProgressReporter progress_;
  CurveFound found_;
  CurveMeasures measures_;
  double way_beyond_ = 0;  ///< of the nodes that were found
  Resampled nodes_{.curve = {}, .constraints = Constraints(0), .from = {}};
};

/// With the root mean square that noise leaves in place of its deviation.
FitOptions with_rms_of_noise(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                             const FitOptions& options, Context& context) {
  FitOptions found = options;
  found.criterion = RootMeanSquare{*options.noise()};
  CurveFitInput input(curve, constraints, points, options, context);
  if (!input.pulls()) return found;
  try {
    const CancellationScope cancellation(context);
    if (options.outliers > 0) input.leave_outliers_out();
    const double rms = rms_of_noise(input.task()) / input.scale();
    if (rms > 0) found.criterion = RootMeanSquare{rms};
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
  if (options.noise()) {
    const FitOptions found = with_rms_of_noise(curve, constraints, points, options, context);
    FitResult result = fit_curve(curve, constraints, points, found, context);
    result.report.noise_leaves = found.rms();
    return result;
  }
  const Stopwatch stopwatch;
  CurveFit run(curve, constraints, points, options, context);
  if (!run.input().pulls()) {
    FairResult plain = fair(curve, constraints, options.fair, context);
    FitResult result = run.result(std::move(plain.positions), {curve, constraints, {}});
    result.report.fair = std::move(plain.report);
    return result;
  }
  if (auto plain = run.plain_fairing()) return *std::move(plain);
  std::vector<Vector3> positions;
  if (run.find([&] { return own_nodes(run.input(), run.found()); })) {
    positions = run.nodes().curve.positions();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (options.fair.strength < 1 && !constraints.position_fixed(static_cast<Index>(i)))
        positions[i] = curve.positions()[i] + options.fair.strength * (positions[i] - curve.positions()[i]);
    }
  } else {
    positions = unchanged(run.input());
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
  fair.seconds = stopwatch.seconds();
  return result;
}

ResampledFit fit_curve_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                                 const FitOptions& options, Context& context) {
  if (Profile::is_needed(curve, constraints, options)) {
    const Profile profile(curve, constraints, options);
    ResampledFit made = fit_curve_resampled(profile.curve(), profile.constraints(), how, profile.options(), context);
    profile.lift(made);
    return made;
  }
  const ScatteredPoints points{.positions = curve.positions()};
  if (options.noise()) {
    const FitOptions found = with_rms_of_noise(curve, constraints, points, options, context);
    ResampledFit made = fit_curve_resampled(curve, constraints, how, found, context);
    made.fit.report.noise_leaves = found.rms();
    return made;
  }
  const Stopwatch stopwatch;
  ResampledFit made{resample(curve, constraints, how), {}};
  CurveFit run(curve, constraints, points, options, context);
  if (run.input().pulls() && run.find([&] { return new_nodes(run.input(), run.found(), how); }))
    made.resampled = run.nodes();
  made.fit = run.result(made.resampled.curve.positions(), made.resampled);
  FairReport& fair = made.fit.report.fair;
  const Distance moves = distance(made.fit.positions, curve);
  fair.greatest_move = moves.greatest;
  fair.rms_move = moves.rms;
  fair.seconds = stopwatch.seconds();
  return made;
}

}  // namespace vspring
