// Scattered points (§4.5, indirect constraints).

#include "vspring/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "constraints/holding.hpp"
#include "fairness/measure.hpp"
#include "fit/nearest_nodes.hpp"
#include "fit/point_factors.hpp"
#include "fit/point_ties.hpp"
#include "solve/account.hpp"
#include "solve/fit_points.hpp"
#include "solve/pulled_shape.hpp"
#include "solve/sweep_method.hpp"
#include "solve/tolerance_fit.hpp"
#include "spring/curve_net.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

using Clock = std::chrono::steady_clock;

// The last steps of a plain iteration are about k times their distance.
constexpr double step_share = 0.1;
// The smoothing lengths that tolerances are looked for from, in mean edges.
constexpr double first_lengths[] = {3, 1, 0.3, 0.1};
// Of a tolerance, to which equilibria are found.
constexpr double precision = 1e-3;
// Of outliers and shape.
constexpr int most_turns = 12;

/// What is said in other words of surfaces and of curves.
void mark_nodes(const PolygonMesh& mesh, std::vector<std::uint8_t>& marks) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() < 3) continue;
    for (const Index node : face) marks[static_cast<std::size_t>(node)] = 1;
  }
}

void mark_nodes(const PolygonCurve& curve, std::vector<std::uint8_t>& marks) {
  for (const auto& chain : curve.chains()) {
    for (const Index node : chain.nodes) marks[static_cast<std::size_t>(node)] = 1;
  }
}

Index faces_of(const PolygonMesh& mesh) { return mesh.face_count(); }
Index faces_of(const PolygonCurve& /*curve*/) { return 0; }

Fairness fairness_of(const PolygonMesh& mesh, const Constraints& constraints, ThreadTeam& team) {
  return measure(mesh, &constraints, team);
}
Fairness fairness_of(const PolygonCurve& curve, const Constraints& constraints, ThreadTeam& /*team*/) {
  return measure(curve, &constraints);
}

double diagonal_of(const Net& net) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : net.positions) box.extend(position);
  return box.isEmpty() ? 1 : box.diagonal().norm();
}

template <typename Shape>
class Fitting {
 public:
  Fitting(const Shape& shape, const Constraints& constraints, const ScatteredPoints& points, const FitOptions& options,
          Context& context)
      : shape_(shape),
        constraints_(constraints),
        points_(points),
        options_(options),
        context_(context),
        team_(context.thread_count()) {
    // Distances are measured even after somebody has cancelled.
    measuring_.threads = context.threads;
  }

  FitResult run() {
    const auto begin = Clock::now();
    if (constraints_.node_count() != shape_.node_count()) (void)check_constraints(shape_, constraints_);
    ProgressReporter progress(context_);
    progress.report("preparing", 0);
    FitReport& report = result_.report;
    FairReport& fair = report.fair;
    kept_.assign(points_.positions.size(), 1);
    if (options_.outliers > 0) {
      leave_outliers_out(progress);
    } else {
      fit(progress, false);
    }

    fair.before = fairness_of(shape_, constraints_, team_);
    fair.after = fairness_of(fitted(), constraints_, team_);
    const std::vector<std::uint8_t> every(kept_.size(), 1);
    report.before = summary(point_distances(points_.positions, shape_, measuring_), every);
    result_.distances = distances();
    report.after = summary(result_.distances, kept_);
    report.outliers = report.points - report.after.all.count;
    fair.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Shape fitted() const {
    Shape fitted = shape_;
    fitted.set_positions(result_.positions);
    return fitted;
  }

  [[nodiscard]] std::vector<double> distances() const {
    return point_distances(points_.positions, fitted(), measuring_);
  }

  /// The report of a fit that begins.
  void start_report(Method method) {
    result_.report = {};
    FairReport& fair = result_.report.fair;
    fair.method = method;
    fair.threads = team_.size();
    fair.faces = faces_of(shape_);
    result_.report.points = static_cast<Index>(points_.positions.size());
  }

  /// Fits and leaves out the points that are furthest away, in turns, until they stay the same.
  void leave_outliers_out(ProgressReporter& progress) {
    const bool searches = options_.within || options_.rms;
    // A tolerance means nothing as long as outliers count.
    bool smooth_first = searches;
    for (int turn = 0; turn < most_turns; ++turn) {
      fit(progress, smooth_first);
      if (context_.cancelled()) return;
      const auto before = std::exchange(kept_, without_furthest(distances(), options_.outliers));
      if (before != kept_) continue;
      if (!smooth_first) return;
      smooth_first = false;
    }
    if (smooth_first) fit(progress, false);
    result_.report.fair.warnings.emplace_back(
        "the outliers went on changing with the shape: the last ones are left out");
  }

  /// smooth: by some edges, instead of to a tolerance.
  void fit(ProgressReporter& progress, bool smooth) {
    start_report(options_.fair.method.value_or(Method::equilibrium));
    FairReport& report = result_.report.fair;
    LoosePoints points = loose_points();
    const auto has_weight = [](double weight) { return weight > 0; };
    if (std::none_of(points.weights.begin(), points.weights.end(), has_weight)) {
      FairResult plain = vspring::fair(shape_, constraints_, options_.fair, context_);
      report = std::move(plain.report);
      result_.positions = std::move(plain.positions);
      return;
    }
    std::vector<std::uint8_t> pulled(static_cast<std::size_t>(shape_.node_count()), 0);
    for (std::size_t j = 0; j < points.nearest.size(); ++j) {
      if (points.nearest[j] >= 0 && has_weight(points.weights[j]))
        pulled[static_cast<std::size_t>(points.nearest[j])] = 1;
    }
    report.warnings = check_constraints(shape_, constraints_, pulled);
    if (report.method == Method::sweep) {
      sweep(std::move(points), options_.fair, progress);
      return;
    }
    if (options_.within || options_.rms) {
      fit_to_tolerance(std::move(points), progress, smooth);
      return;
    }
    go_to_equilibrium(std::move(points), progress);
    const bool found = report.outcome == Outcome::converged || report.outcome == Outcome::cancelled;
    if (found || options_.fair.method || options_.fair.max_iterations) return;
    // Nobody asked for this method: the paper's iteration ends where points crumple a shape, too.
    std::vector<std::string> warnings = std::move(report.warnings);
    warnings.emplace_back(
        "no equilibrium was found: this is the plain iteration's shape; the points may be too noisy for their weight "
        "and for edges as short as these, or too little may be held: hold more nodes, let a smaller region move, or "
        "keep the distribution of the nodes");
    start_report(Method::sweep);
    report.warnings = std::move(warnings);
    FairOptions options = options_.fair;
    if (!options_.smoothing_length)
      options.step_tolerance = std::min(options.step_tolerance, step_share * options_.weight);
    sweep(loose_points(), options, progress);
  }

  void go_to_equilibrium(LoosePoints points, ProgressReporter& progress) {
    auto gathered = gather();
    const auto smoothing = smoothing_in(net_of(gathered));
    PulledShape shape(std::move(gathered), options_.fair, std::move(points), smoothing, team_);
    shape.find(context_, progress, result_.report.fair);
    finish(shape.net());
  }

  void fit_to_tolerance(LoosePoints points, ProgressReporter& progress, bool smooth) {
    FitReport& report = result_.report;
    const double tolerance = options_.within ? *options_.within : *options_.rms;
    const auto figure_of = [&](const std::vector<double>& distances) {
      double greatest = 0;
      double squares = 0;
      double count = 0;
      for (std::size_t j = 0; j < distances.size(); ++j) {
        greatest = std::max(greatest, distances[j]);
        squares += distances[j] * distances[j];
        count += kept_[j];
      }
      return options_.within ? greatest : std::sqrt(squares / count);
    };
    if (!smooth && plain_fairing_is_within(tolerance, figure_of)) return;
    auto gathered = gather();
    const double scale = net_of(gathered).frame.scale();
    const double edge = mean_edge(net_of(gathered));
    const auto length = std::make_shared<double>(edge);
    FairOptions options = options_.fair;
    options.tolerance = std::min(options.tolerance, precision * tolerance * scale / diagonal_of(net_of(gathered)));
    PulledShape shape(std::move(gathered), options, std::move(points), length, team_);
    // Long lengths bridge what is noise; short ones leave a start that is near its points as it is.
    const std::vector<Vector3> start = shape.net().positions;
    for (const double first : first_lengths) {
      *length = first * edge;
      shape.net().positions = start;
      shape.find(context_, progress, report.fair);
      if (report.fair.outcome == Outcome::converged || context_.cancelled()) break;
    }
    const auto finish_with = [&](double found) {
      finish(shape.net());
      report.smoothing_length = found / scale;
    };
    if (smooth || context_.cancelled()) {
      finish_with(*length);
      return;
    }
    ToleranceFitTask task;
    task.net = &shape.net();
    task.length = length;
    task.follow = [&] {
      FairReport one;
      shape.follow(context_, progress, one);
      report.fair.iterations += one.iterations;
      report.fair.history.insert(report.fair.history.end(), one.history.begin(), one.history.end());
      report.fair.residual = one.residual;
      report.fair.expected_error = one.expected_error;
      report.fair.outcome = one.outcome;
      return one.outcome == Outcome::converged;
    };
    task.cancelled = [&] { return context_.cancelled(); };
    task.measure = [&] {
      finish_positions(shape.net());
      std::vector<double> all = distances();
      for (std::size_t j = 0; j < all.size(); ++j) all[j] = kept_[j] != 0 ? all[j] * scale : 0;
      return all;
    };
    task.energy = [&] { return fairness_of(fitted(), constraints_, team_).vspring_energy; };
    const auto local_figure = [&](const std::vector<double>& all) { return figure_of(all); };
    ToleranceFitResult found = smooth_within(task, tolerance * scale, local_figure);
    if (options_.within && !context_.cancelled()) found = hold_within(task, tolerance * scale, found);
    finish_with(found.length);
    report.active_points = found.active;
    if (context_.cancelled()) {
      report.fair.outcome = Outcome::cancelled;
      return;
    }
    report.fair.outcome = !found.within   ? Outcome::stalled
                          : found.settled ? Outcome::converged
                                          : Outcome::iteration_limit;
    if (!found.within)
      report.fair.warnings.push_back(
          fmt::format("no shape of this mesh was found within {:g}: this is the one that comes nearest; points may lie "
                      "at what is held, or edges may be too long",
                      tolerance));
    else if (!found.settled)
      report.fair.warnings.emplace_back("the shape is within the tolerance, but may not be the fairest that is");
  }

  /// Then that is the fairest.
  template <typename Figure>
  bool plain_fairing_is_within(double tolerance, const Figure& figure_of) {
    try {
      (void)check_constraints(shape_, constraints_);
    } catch (const Error&) {
      // Only points hold it.
      return false;
    }
    FairResult plain = vspring::fair(shape_, constraints_, options_.fair, context_);
    if (plain.report.outcome != Outcome::converged && !context_.cancelled()) return false;
    result_.positions = std::move(plain.positions);
    std::vector<double> all = distances();
    for (std::size_t j = 0; j < all.size(); ++j) all[j] *= kept_[j];
    if (!context_.cancelled() && !(figure_of(all) <= tolerance)) return false;
    result_.report.fair = std::move(plain.report);
    return true;
  }

  void finish_positions(const Net& net) {
    result_.positions = scatter_positions(net, shape_.positions(), constraints_, options_.fair.strength);
  }

  void sweep(LoosePoints points, FairOptions options, ProgressReporter& progress) {
    auto gathered = gather();
    Net& net = net_of(gathered);
    const auto model = model_of(gathered, options);
    distribute(net, *model, options.distribution, team_);
    const auto smoothing = smoothing_in(net);
    PointTies ties(net, points.positions, points.weights, points.nearest,
                   smoothing ? pull_by_smoothing(smoothing) : PointFactors());
    points = {};
    std::function<void()> renew_ties;
    if (!net.points.empty()) renew_ties = [&] { (void)ties.renew(team_); };
    run_sweeps(net, *model, options, team_, context_, progress, result_.report.fair, renew_ties);
    finish(net);
  }

  auto gather() {
    auto gathered = gather_net(shape_, constraints_);
    count_nodes(net_of(gathered), constraints_, result_.report.fair);
    return gathered;
  }

  std::shared_ptr<double> smoothing_in(const Net& net) {
    if (!options_.smoothing_length) return nullptr;
    result_.report.smoothing_length = options_.smoothing_length;
    return std::make_shared<double>(*options_.smoothing_length * net.frame.scale());
  }

  void finish(const Net& net) {
    count_points(net);
    finish_positions(net);
    measure_moves(net, shape_.positions(), result_.positions, result_.report.fair);
  }

  [[nodiscard]] LoosePoints loose_points() {
    std::vector<double> weights = points_.weights;
    weights.resize(points_.positions.size(), 1);
    const double weight = options_.smoothing_length || options_.within || options_.rms ? 1 : options_.weight;
    for (std::size_t j = 0; j < weights.size(); ++j) weights[j] *= kept_[j] * weight;
    if (nearest_.empty()) nearest_ = find_nearest();
    return {points_.positions, std::move(weights), nearest_};
  }

  [[nodiscard]] std::vector<Index> find_nearest() {
    std::vector<Vector3> places = shape_.positions();
    std::vector<std::uint8_t> usable(places.size(), 0);
    mark_nodes(shape_, usable);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto node = static_cast<Index>(i);
      if (constraints_.position_fixed(node)) places[i] = constraints_.position(node);
      if (!places[i].allFinite()) usable[i] = 0;
    }
    return nearest_nodes(points_.positions, places, usable, team_);
  }

  void count_points(const Net& net) {
    FitReport& report = result_.report;
    for (std::size_t i = 0; i < net.moving; ++i) {
      const auto count = static_cast<Index>(net.points.of(i).size());
      report.pulling_points += count;
      report.pulled_nodes += count > 0 ? 1 : 0;
      report.most_points = std::max(report.most_points, count);
    }
  }

  const Shape& shape_;
  const Constraints& constraints_;
  const ScatteredPoints& points_;
  const FitOptions& options_;
  Context& context_;
  Context measuring_;
  ThreadTeam team_;
  FitResult result_;
  std::vector<std::uint8_t> kept_;  // of every point, 0 for those left out
  std::vector<Index> nearest_;      // the node nearest to every point at the start
};

template <typename Shape>
FitResult fit_shape(const Shape& shape, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context) {
  options.validate();
  check_points(points);
  return Fitting<Shape>(shape, constraints, points, options, context).run();
}

}  // namespace

FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options, Context& context) {
  return fit_shape(mesh, constraints, points, options, context);
}

FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options) {
  Context context;
  return fit(mesh, constraints, points, options, context);
}

FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options, Context& context) {
  return fit_shape(curve, constraints, points, options, context);
}

FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options) {
  Context context;
  return fit(curve, constraints, points, options, context);
}

}  // namespace vspring
