// Scattered points (§4.5, indirect constraints).

#include "vspring/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "constraints/holding.hpp"
#include "fairness/measure.hpp"
#include "fit/nearest_nodes.hpp"
#include "fit/point_ties.hpp"
#include "levels/curve_levels.hpp"
#include "levels/surface_levels.hpp"
#include "solve/account.hpp"
#include "solve/curve_hierarchy.hpp"
#include "solve/equilibrium_method.hpp"
#include "solve/surface_hierarchy.hpp"
#include "solve/sweep_method.hpp"
#include "spring/curve_net.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double largest_weight = 1e50;
// The last steps of a plain iteration are about k times their distance.
constexpr double step_share = 0.1;

bool is_weight(double weight) { return weight >= 0 && weight <= largest_weight; }

void check_points(const ScatteredPoints& points) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  const std::size_t count = points.positions.size();
  if (count == 0) refuse("there are no points to fit to");
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    refuse(fmt::format("{} points are more than there may be: {}", count, std::numeric_limits<Index>::max()));
  if (!points.weights.empty() && points.weights.size() != count)
    refuse(fmt::format("{} weights are given for {} points: one for each is needed, or none", points.weights.size(),
                       count));
  for (std::size_t j = 0; j < count; ++j) {
    if (!points.positions[j].allFinite()) refuse(fmt::format("point {} is not finite; leave it out", j));
  }
  for (std::size_t j = 0; j < points.weights.size(); ++j) {
    if (!is_weight(points.weights[j]))
      refuse(
          fmt::format("the weight of point {} must be from 0 to {:g}, not {}", j, largest_weight, points.weights[j]));
  }
}

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

Net& net_of(Net& net) { return net; }
Net& net_of(CurveNet& curve) { return curve.net; }

auto model_of(const Net& /*net*/, const FairOptions& options) { return surface_model(options.pseudo_normals); }
auto model_of(const CurveNet& curve, const FairOptions& options) { return curve_model_for(curve.net, options.curve); }

SurfaceHierarchy hierarchy_of(Net net, const Model& model, Distribution distribution, ThreadTeam& team) {
  return {surface_levels(std::move(net), model, distribution, team), team};
}
CurveHierarchy hierarchy_of(CurveNet curve, const Model& /*model*/, Distribution distribution, ThreadTeam& /*team*/) {
  return CurveHierarchy(curve_levels(std::move(curve), distribution));
}

Index faces_of(const PolygonMesh& mesh) { return mesh.face_count(); }
Index faces_of(const PolygonCurve& /*curve*/) { return 0; }

Fairness fairness_of(const PolygonMesh& mesh, const Constraints& constraints, ThreadTeam& team) {
  return measure(mesh, &constraints, team);
}
Fairness fairness_of(const PolygonCurve& curve, const Constraints& constraints, ThreadTeam& /*team*/) {
  return measure(curve, &constraints);
}

PointDistances summary(std::vector<double> distances) {
  PointDistances result;
  const auto furthest = std::max_element(distances.begin(), distances.end());
  Distance& all = result.all;
  all.greatest = *furthest;
  all.node = static_cast<Index>(furthest - distances.begin());
  all.count = static_cast<Index>(distances.size());
  double squares = 0;
  for (const double distance : distances) {
    const double share = all.greatest > 0 ? distance / all.greatest : 0;
    squares += share * share;
  }
  all.rms = all.greatest * std::sqrt(squares / static_cast<double>(distances.size()));
  const auto percentile = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(distances.size())));
    const auto place = distances.begin() + rank - 1;
    std::nth_element(distances.begin(), place, distances.end());
    return *place;
  };
  result.median = percentile(0.5);
  result.percentile90 = percentile(0.9);
  result.percentile99 = percentile(0.99);
  return result;
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
    fair.method = options_.fair.method.value_or(Method::equilibrium);
    fair.threads = team_.size();
    fair.faces = faces_of(shape_);
    report.points = static_cast<Index>(points_.positions.size());
    fit(progress);

    Shape fitted = shape_;
    fitted.set_positions(result_.positions);
    fair.before = fairness_of(shape_, constraints_, team_);
    fair.after = fairness_of(fitted, constraints_, team_);
    report.before = summary(point_distances(points_.positions, shape_, measuring_));
    result_.distances = point_distances(points_.positions, fitted, measuring_);
    report.after = summary(result_.distances);
    fair.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  void fit(ProgressReporter& progress) {
    FairReport& report = result_.report.fair;
    std::vector<double> weights = point_weights();
    if (std::none_of(weights.begin(), weights.end(), [](double weight) { return weight > 0; })) {
      FairResult plain = vspring::fair(shape_, constraints_, options_.fair, context_);
      report = std::move(plain.report);
      result_.positions = std::move(plain.positions);
      return;
    }
    std::vector<Index> nearest = find_nearest();
    std::vector<std::uint8_t> pulled(static_cast<std::size_t>(shape_.node_count()), 0);
    for (std::size_t j = 0; j < nearest.size(); ++j) {
      if (nearest[j] >= 0 && weights[j] > 0) pulled[static_cast<std::size_t>(nearest[j])] = 1;
    }
    report.warnings = check_constraints(shape_, constraints_, pulled);
    if (report.method == Method::sweep) {
      sweep(std::move(weights), std::move(nearest), options_.fair, progress);
      return;
    }
    go_to_equilibrium(std::move(weights), std::move(nearest), progress);
    const bool found = report.outcome == Outcome::converged || report.outcome == Outcome::cancelled;
    if (!found && report.fixed_positions == 0)
      report.warnings.emplace_back(
          "nothing but points holds this shape, and its nodes went on sliding along it: this is the shape of the "
          "smallest steps; hold a node or two, or keep the distribution of the nodes");
    if (found || options_.fair.method || options_.fair.max_iterations || report.fixed_positions == 0) return;
    // Nobody asked for this method: the paper's iteration ends where points crumple a shape, too.
    FitReport anew;
    anew.points = result_.report.points;
    anew.fair.method = Method::sweep;
    anew.fair.threads = report.threads;
    anew.fair.faces = report.faces;
    anew.fair.warnings = std::move(report.warnings);
    anew.fair.warnings.emplace_back(
        "no equilibrium was found: this is the plain iteration's shape; the points may be too noisy for their weight "
        "and for edges as short as these");
    result_.report = std::move(anew);
    FairOptions options = options_.fair;
    options.step_tolerance = std::min(options.step_tolerance, step_share * options_.weight);
    sweep(point_weights(), find_nearest(), options, progress);
  }

  void go_to_equilibrium(std::vector<double> weights, std::vector<Index> nearest, ProgressReporter& progress) {
    auto gathered = gather_net(shape_, constraints_);
    count_nodes(net_of(gathered), constraints_, result_.report.fair);
    const auto model = model_of(gathered, options_.fair);
    auto hierarchy = hierarchy_of(std::move(gathered), *model, options_.fair.distribution, team_);
    Net& net = hierarchy.net(hierarchy.count() - 1);
    PointTies ties(net, points_.positions, weights, nearest);
    weights = {};
    nearest = {};
    PointLevels levels(hierarchy, ties, team_);
    run_equilibrium(hierarchy, *model, options_.fair, team_, context_, progress, result_.report.fair,
                    net.points.empty() ? nullptr : &levels);
    finish(net);
  }

  void sweep(std::vector<double> weights, std::vector<Index> nearest, const FairOptions& options,
             ProgressReporter& progress) {
    auto gathered = gather_net(shape_, constraints_);
    Net& net = net_of(gathered);
    count_nodes(net, constraints_, result_.report.fair);
    const auto model = model_of(gathered, options);
    distribute(net, *model, options.distribution, team_);
    PointTies ties(net, points_.positions, weights, nearest);
    weights = {};
    nearest = {};
    std::function<void()> renew_ties;
    if (!net.points.empty()) renew_ties = [&] { (void)ties.renew(team_); };
    run_sweeps(net, *model, options, team_, context_, progress, result_.report.fair, renew_ties);
    finish(net);
  }

  void finish(const Net& net) {
    count_points(net);
    result_.positions = scatter_positions(net, shape_.positions(), constraints_, options_.fair.strength);
    measure_moves(net, shape_.positions(), result_.positions, result_.report.fair);
  }

  [[nodiscard]] std::vector<double> point_weights() const {
    std::vector<double> weights = points_.weights;
    weights.resize(points_.positions.size(), 1);
    for (double& weight : weights) weight *= options_.weight;
    return weights;
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
};

template <typename Shape>
FitResult fit_shape(const Shape& shape, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context) {
  options.validate();
  check_points(points);
  return Fitting<Shape>(shape, constraints, points, options, context).run();
}

}  // namespace

void FitOptions::validate() const {
  fair.validate();
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  if (!is_weight(weight)) refuse(fmt::format("weight must be from 0 to {:g}, not {}", largest_weight, weight));
  if (fair.method == Method::multigrid)
    refuse("points can be fitted by the methods equilibrium and sweep, not by multigrid");
  if (fair.fair_boundary) refuse("points cannot be fitted while the boundary is faired: fair the boundary first");
}

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
