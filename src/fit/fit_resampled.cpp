// New nodes on a curve that fits the nodes of a table, and not on the cubics through them.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "constraints/dense_resampling.hpp"
#include "curve_fit/gentle_curve.hpp"
#include "fairness/counted.hpp"
#include "fit/fit_points.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "shape/segment.hpp"
#include "vspring/distance.hpp"
#include "vspring/figures.hpp"
#include "vspring/fit.hpp"

namespace vspring {

namespace {

// Edges that each of the new ones is cut into, at most.
constexpr Index most_times = 8;
// And nodes that they may come to, as those of a table that is fitted by itself first: larger ones take seconds.
constexpr Index most_dense_nodes = 5'000;
// Nodes of the dense curve for each point: with fewer a node has several points, or rounding decides which.
constexpr double nodes_a_point = 2;
// By how much edges of the dense curve may rise over their chords, of the tolerance.
constexpr double greatest_dense_rise = 0.02;
// Fits of the dense curve, two at least: for the first it is not known well how much edges will rise.
constexpr int most_dense_fits = 6;
// Of the tolerance, in the first of them, and of what is left to the next.
constexpr double first_aim = 0.998;
constexpr double next_aim = 0.998;
constexpr double least_next_aim = 0.8;
// Of the energy before: where it still falls the solver has stopped early.
constexpr double settles_at_share = 0.95;
// Of the tolerance: a dense curve that is nearly within may be so the next time.
constexpr double hopeless_share = 1.5;
// Of the least distance before: where it falls no more nothing is within the tolerance.
constexpr double no_nearer_share = 0.98;
// Of the tolerance: where no gentle curve is within it, one is looked for up to so much further out, to so near.
constexpr double most_times_tolerance = 8;
constexpr double nearly = 1.05;
// Of the variation along the resampled table.
constexpr double greatest_strain = 1.5;

/// Fits a curve with several nodes for each that is asked for; these are some of its nodes.
class DenseFit {
 public:
  DenseFit(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how, const Resampled& made,
           const FitOptions& options, Context& context)
      : curve_(curve),
        constraints_(constraints),
        how_(how),
        made_(made),
        options_(options),
        context_(context),
        tolerance_(options.tolerance().value_or(0)) {
    measuring_.threads = context.threads;
  }

  /// Whether it found new nodes within the tolerance, or somebody has cancelled: those are to be taken.
  bool run() {
    if (curve_.node_count() > most_dense_nodes) return false;
    const bool is_too_large_a_table = curve_.node_count() > most_times * made_.curve.node_count();
    if (is_too_large_a_table && !options_.within()) return false;
    FitResult own = fit(curve_, constraints_, {.positions = curve_.positions()}, options_, context_);
    if (own.report.fair.outcome == Outcome::worse_than_input) return false;
    PolygonCurve smooth = curve_;
    smooth.set_positions(std::move(own.positions));
    if (options_.within() && go_gently(own, smooth)) return true;
    if (is_too_large_a_table) return false;
    resample_to(smooth, 2);
    const Index times = times_needed();
    if (times != times_) resample_to(smooth, times);
    own.positions = dense_.curve.positions();
    take_new_nodes(own, dense_.curve);
    if (own.report.fair.outcome != Outcome::stalled) tried_.push_back(std::move(own));
    FitOptions options = options_;
    double aim = first_aim;
    double energy = std::numeric_limits<double>::infinity();
    double nearest_share = energy;
    for (int k = 0; k < most_dense_fits; ++k) {
      if (options_.within()) options.criterion = Within{aim * tolerance_};
      if (options_.rms()) options.criterion = RootMeanSquare{aim * tolerance_};
      FitResult found = fit(dense_.curve, dense_.constraints, {.positions = raised_points()}, options, context_);
      const Outcome outcome = found.report.fair.outcome;
      const bool stalled = outcome == Outcome::stalled;
      if (outcome == Outcome::worse_than_input || (stalled && !(figure(found) <= hopeless_share * tolerance_))) break;
      dense_.curve.set_positions(found.positions);
      take_new_nodes(found, dense_.curve);
      const double share = tolerance_ > 0 ? figure(found) / tolerance_ : 0;
      const double before = std::exchange(energy, measure(dense_.curve, &dense_.constraints).vspring_energy);
      const bool nearer = !(share > no_nearer_share * nearest_share);
      const bool is_better = share <= 1 && !(stalled && is_within());
      if (is_better || context_.cancelled()) {
        best_ = std::move(found);
        best_share_ = share;
      } else if (!stalled) {
        tried_.push_back(std::move(found));
      }
      nearest_share = std::min(nearest_share, share);
      if (context_.cancelled()) break;
      if (k == 0) continue;
      if (share <= 1 ? stalled || energy >= settles_at_share * before : !stalled && k > 1 && !nearer) break;
      if (share > 1) aim *= std::clamp(next_aim / share, least_next_aim, next_aim);
    }
    return best_.has_value();
  }

  /// Where nothing is within the tolerance, not new nodes that were fitted by themselves either: of these and all that
  /// were tried the nearest of those whose curvature varies no more than before; where it varies more in all, the
  /// nearest.
  FitResult take_nearest(FitResult fitted) {
    const double before = variation(made_.curve.positions());
    const auto is_worse = [&](const FitResult& one) { return variation(one.positions) > before; };
    const FitResult* nearest = &fitted;
    bool worse = is_worse(fitted);
    for (const FitResult& one : tried_) {
      const bool one_is_worse = is_worse(one);
      if (one_is_worse != worse ? one_is_worse : figure(one) >= figure(*nearest)) continue;
      nearest = &one;
      worse = one_is_worse;
    }
    if (nearest == &fitted) return fitted;
    best_ = *nearest;
    return take();
  }

  /// With a report of the new nodes.
  FitResult take() {
    FitReport& report = best_->report;
    FairReport& fair = report.fair;
    fair.nodes = made_.curve.node_count();
    fair.moving_nodes = 0;
    fair.fixed_positions = 0;
    for (Index i = 0; i < fair.nodes; ++i)
      ++(made_.constraints.position_fixed(i) ? fair.fixed_positions : fair.moving_nodes);
    // Along the curve they lie elsewhere, as bends are elsewhere without noise.
    const Distance moves = distance(best_->positions, made_.curve, measuring_);
    const double nodes_per_moving = static_cast<double>(fair.nodes) / std::max<Index>(fair.moving_nodes, 1);
    fair.greatest_move = moves.greatest;
    fair.rms_move = moves.rms * std::sqrt(nodes_per_moving);
    report.before = summary_of(point_distances(curve_.positions(), made_.curve, measuring_));
    const auto count = [&](double beyond) {
      const auto& all = best_->distances;
      return static_cast<Index>(std::count_if(all.begin(), all.end(), [&](double d) { return d > beyond; }));
    };
    if (options_.within()) report.active_points = active_points(best_->distances, {}, tolerance_);
    report.outside_points = tolerance_ > 0 ? count(tolerance_) : 0;
    if (is_within() && fair.outcome == Outcome::stalled) {
      // The dense curve is a little further from points next to what is held than was aimed at, and says so last.
      fair.outcome = Outcome::work_limit;
      fair.warnings.back() = {WarningCode::maybe_not_fairest,
                              "the shape is within the tolerance, but may not be the fairest"};
    } else if (!is_within() && fair.outcome != Outcome::cancelled) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back(
          {WarningCode::outside_tolerance, fmt::format("no shape of so many nodes was found within {:g}: this is a "
                                                       "fair one that comes near; edges may be too long, "
                                                       "or points lie at what is held",
                                                       tolerance_)});
    }
    return std::move(*best_);
  }

 private:
  /// The gentle curve of new nodes within the tolerance, or one that is as near as can be without being strained. False
  /// where there is none, as in space.
  bool go_gently(const FitResult& own, const PolygonCurve& smooth) {
    resample_to(smooth, 1);
    const CurveFigures figures = measure_curve(smooth, &constraints_);
    best_ = gentle_within(own, figures, tolerance_);
    if (best_ && figure(*best_) <= tolerance_) {
      best_share_ = figure(*best_) / tolerance_;
      return true;
    }
    best_.reset();
    double too_near = 1;
    double share = most_times_tolerance;
    for (double next = share; share > nearly * too_near; next = std::sqrt(share * too_near)) {
      auto found = gentle_within(own, figures, next * tolerance_);
      if (context_.cancelled() || (!found && !best_)) return false;
      (found ? share : too_near) = next;
      if (found) best_ = std::move(found);
    }
    best_share_ = figure(*best_) / tolerance_;
    return true;
  }

  /// None where it is strained: where curvature varies more than along the resampled table, and has more inflections or
  /// extremes than along the table without its noise, or varies more by half, or more at all beyond the tolerance.
  std::optional<FitResult> gentle_within(const FitResult& own, const CurveFigures& smooth, double tolerance) {
    const double before = variation(made_.curve.positions());
    std::optional<std::vector<Vector3>> best;
    double least = std::numeric_limits<double>::infinity();
    for (const LeastVariation which : {LeastVariation::in_proportion, LeastVariation::in_all}) {
      auto places = gentle_curve(dense_.curve, dense_.constraints, curve_.positions(), tolerance,
                                 static_cast<std::size_t>(smooth.curvature_extrema), context_, which);
      if (!places) break;
      PolygonCurve curve = dense_.curve;
      curve.set_positions(*places);
      const CurveFigures figures = measure_curve(curve, &dense_.constraints);
      const bool has_more =
          figures.curvature_extrema > smooth.curvature_extrema || figures.inflections > smooth.inflections;
      const double most = has_more || tolerance > tolerance_ ? before : greatest_strain * before;
      if (figures.curvature_variation <= most && figures.curvature_variation < least && !(best && has_more)) {
        least = figures.curvature_variation;
        best = std::move(places);
      }
      if (least <= before) break;
    }
    if (!best) return std::nullopt;
    FitResult found = own;
    PolygonCurve dense = dense_.curve;
    dense.set_positions(*std::move(best));
    take_new_nodes(found, dense);
    found.report.fair.outcome = Outcome::converged;
    found.report.fair.warnings.clear();
    return found;
  }

  struct DenseEdge {
    std::array<Index, 2> nodes;
    std::array<Index, 2> chord;  ///< nodes of the dense curve that are new ones
  };

  [[nodiscard]] bool is_within() const { return best_share_ <= 1; }

  /// What is to be within the tolerance.
  [[nodiscard]] double figure(const FitResult& found) const {
    return options_.within() ? found.report.after.all.greatest : found.report.after.all.rms;
  }

  [[nodiscard]] double variation(const std::vector<Vector3>& nodes) const {
    PolygonCurve curve = made_.curve;
    curve.set_positions(nodes);
    return measure_curve(curve, &made_.constraints).curvature_variation;
  }

  void resample_to(const PolygonCurve& smooth, Index times) {
    times_ = times;
    dense_ = resample_densely(curve_, smooth, constraints_, how_, times);
    edges_.clear();
    dense_node_.assign(made_.from.size(), -1);
    for (std::size_t c = 0; c < made_.curve.chains().size(); ++c) {
      const auto& chain = made_.curve.chains()[c];
      const std::vector<Index>& nodes = dense_.curve.chains()[c].nodes;
      const auto step = static_cast<std::size_t>(times);
      for (std::size_t k = 0; k < chain.nodes.size(); ++k)
        dense_node_[static_cast<std::size_t>(chain.nodes[k])] = nodes[k * step];
      for (std::size_t k = 0; k + 1 < nodes.size() + (chain.closed ? 1 : 0); ++k) {
        const std::size_t from = k / step * step;
        edges_.push_back(
            {{nodes[k], nodes[(k + 1) % nodes.size()]}, {nodes[from], nodes[(from + step) % nodes.size()]}});
      }
    }
  }

  /// For edges of the dense curve that rise little, and nodes enough for the points.
  [[nodiscard]] Index times_needed() const {
    double rise = 0;
    for (const DenseEdge& edge : edges_) rise = std::max(rise, over_chord(edge, at(edge.nodes[1])).norm());
    const double nodes = made_.curve.node_count();
    double times = std::ceil(nodes_a_point * static_cast<double>(curve_.positions().size()) / nodes);
    if (tolerance_ > 0) times = std::max(times, std::ceil(std::sqrt(rise / (greatest_dense_rise * tolerance_))));
    const double most = std::min<double>(most_times, std::floor(most_dense_nodes / nodes));
    return static_cast<Index>(std::clamp(times, 1.0, std::max(most, 1.0)));
  }

  [[nodiscard]] const Vector3& at(Index node) const { return dense_.curve.position(node); }

  [[nodiscard]] Vector3 over_chord(const DenseEdge& edge, const Vector3& place) const {
    const Vector3& a = at(edge.chord[0]);
    const Vector3& b = at(edge.chord[1]);
    return place - a - nearest_share(place, a, b) * (b - a);
  }

  /// The points, each by as much further out as the dense curve rises there over the chord between new nodes: so the
  /// dense curve is as far from them as these chords from the points themselves.
  [[nodiscard]] std::vector<Vector3> raised_points() const {
    std::vector<Vector3> points = curve_.positions();
    Box box;
    for (const Vector3& point : points) box.extend(point);
    for (const Vector3& node : dense_.curve.positions()) box.extend(node);
    const Frame frame(box);
    const std::vector<Vector3> nodes = placed(dense_.curve.positions(), frame);
    const auto start = [&](Index edge) -> const Vector3& {
      return nodes[static_cast<std::size_t>(edges_[static_cast<std::size_t>(edge)].nodes[0])];
    };
    const auto end = [&](Index edge) -> const Vector3& {
      return nodes[static_cast<std::size_t>(edges_[static_cast<std::size_t>(edge)].nodes[1])];
    };
    std::vector<Box> boxes(edges_.size());
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      boxes[k].extend(start(static_cast<Index>(k)));
      boxes[k].extend(end(static_cast<Index>(k)));
    }
    ThreadTeam team(context_.thread_count());
    const BoxTree tree(std::move(boxes), team);
    for (Vector3& point : points) {
      const Vector3 place = frame.to_local(point);
      const auto nearest = tree.nearest(place, [&](Index k) {
        return (place - start(k) - nearest_share(place, start(k), end(k)) * (end(k) - start(k))).squaredNorm();
      });
      const DenseEdge& edge = edges_[static_cast<std::size_t>(nearest.item)];
      const Vector3& a = at(edge.nodes[0]);
      const Vector3& b = at(edge.nodes[1]);
      point += over_chord(edge, a + nearest_share(place, start(nearest.item), end(nearest.item)) * (b - a));
    }
    return points;
  }

  static PointDistances summary_of(const std::vector<double>& distances) {
    return summary(distances, std::vector<std::uint8_t>(distances.size(), 1));
  }

  /// In place of the nodes of the dense curve.
  void take_new_nodes(FitResult& found, const PolygonCurve& dense) const {
    found.positions.resize(dense_node_.size());
    for (std::size_t i = 0; i < dense_node_.size(); ++i) found.positions[i] = dense.position(dense_node_[i]);
    PolygonCurve made = made_.curve;
    made.set_positions(found.positions);
    found.distances = point_distances(curve_.positions(), made, measuring_);
    found.report.after = summary_of(found.distances);
  }

  const PolygonCurve& curve_;
  const Constraints& constraints_;
  const Resampling& how_;
  const Resampled& made_;
  const FitOptions& options_;
  Context& context_;
  Context measuring_;  // after somebody has cancelled, too
  double tolerance_;   // 0: none
  Index times_ = 1;
  Resampled dense_{.curve = {}, .constraints = Constraints(0), .from = {}};
  std::vector<Index> dense_node_;  // of every new node
  std::vector<DenseEdge> edges_;
  std::optional<FitResult> best_;
  std::vector<FitResult> tried_;                                 // that are not within
  double best_share_ = std::numeric_limits<double>::infinity();  // of the tolerance
};

/// Whether a weight of points means the same for more nodes, and nothing is said of how the solver is to go.
bool may_fit_densely(const FitOptions& options) {
  const bool means_the_same = options.tolerance() || options.smoothing_length();
  const bool by_equilibrium = options.fair.method_kind() == Method::equilibrium;
  return means_the_same && by_equilibrium && options.outliers == 0 && options.fair.strength == 1;
}

}  // namespace

ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                           const FitOptions& options, Context& context) {
  const Stopwatch stopwatch;
  options.validate();
  ResampledFit made{resample(curve, constraints, how), {}};
  const auto fit_new_nodes = [&] {
    return fit(made.resampled.curve, made.resampled.constraints, {.positions = curve.positions()}, options, context);
  };
  if (!may_fit_densely(options)) {
    made.fit = fit_new_nodes();
    return made;
  }
  DenseFit dense(curve, constraints, how, made.resampled, options, context);
  if (dense.run()) {
    made.fit = dense.take();
  } else {
    made.fit = fit_new_nodes();
    const bool is_outside = (options.within() || options.rms()) && made.fit.report.fair.outcome == Outcome::stalled;
    if (is_outside) made.fit = dense.take_nearest(std::move(made.fit));
  }
  made.fit.report.fair.seconds = stopwatch.seconds();
  return made;
}

ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                           const FitOptions& options) {
  Context context;
  return fit_resampled(curve, constraints, how, options, context);
}

}  // namespace vspring
