#include "fit/curve_fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "constraints/sides.hpp"
#include "fit/fit_points.hpp"
#include "fit/fit_warnings.hpp"

namespace vspring {

namespace {

// In allowed distances from the polyline: places beyond it are reported.
constexpr double little_beyond = 1.1;

/// The first node at which an edge runs against a tangent given there, or −1.
Index node_against_tangent(const PolygonCurve& curve, const Constraints& constraints) {
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = chain.closed ? 0 : 1; k < count; ++k) {
      const Index before = chain.nodes[(k + count - 1) % count];
      const Index after = chain.nodes[k];
      if (constraints.position_fixed(before) && constraints.position_fixed(after)) continue;
      const Vector3 edge = curve.position(after) - curve.position(before);
      const auto opposes = [&](Index node, NodeSide side) {
        return constraints.tangent_fixed(node, side) && constraints.tangent(node, side).dot(edge) < 0;
      };
      if (opposes(before, NodeSide::after)) return before;
      if (opposes(after, NodeSide::before)) return after;
    }
  }
  return -1;
}

/// What the report says in the end, and warnings.
struct Conclusion {
  const CurveFitInput& input;
  const CurveMeasures& measures;
  const FittedCurve& curve;
  Index against_tangent;  ///< a node, or −1

  void add(FitResult& result, const SharpestNode& most_bent, bool cancelled) const {
    FitReport& report = result.report;
    FairReport& fair = report.fair;
    if (most_bent.node >= 0) {
      report.least_radius = most_bent.radius;
      report.sharpest_node = most_bent.node;
    }
    if (cancelled) {
      fair.outcome = Outcome::cancelled;
      return;
    }
    fair.outcome = curve.found.converged ? Outcome::converged : Outcome::work_limit;
    // Where steps no longer make the curve fairer, the length of the last one is no measure of its error.
    const double tolerance_of_places = std::get<EquilibriumMethod>(input.options().fair.method).tolerance;
    if (!curve.found.converged || curve.found.error <= tolerance_of_places) fair.expected_error = curve.found.error;
    fair.residual = curve.found.error;
    fair.levels.push_back({.moving_nodes = static_cast<Index>(curve.found.curve.size()),
                           .iterations = curve.found.steps,
                           .outcome = fair.outcome,
                           .strategy = "curve through points",
                           .seconds = 0});
    const auto& options = input.options();
    if (curve.new_folds > 0) {
      fair.outcome = Outcome::worse_than_input;
      fair.warnings.push_back(
          {WarningCode::worse_than_input,
           fmt::format("what was found is worse than the input ({} more edges turn by over 120°): {}; try more "
                       "nodes where it is bent most, or another tolerance",
                       curve.new_folds,
                       curve.nodes.from.empty() && !options.fair.accept_worse ? "this is the input with its constraints"
                                                                              : "this is what was found")});
      return;
    }
    const auto tolerance = options.tolerance();
    const bool is_sharp = measures.radius_kept(most_bent) < 1;
    if (is_sharp) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back(
          {WarningCode::radius_not_kept,
           fmt::format(
               "no shape was found whose radius of curvature is at least {:g} everywhere: this one has {:.4g} at "
               "node {}; draw it less closely there, hold less, or allow a smaller radius",
               options.least_radius, most_bent.radius, most_bent.node)});
    }
    if (against_tangent >= 0) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back(
          {WarningCode::against_tangent,
           fmt::format("the curve runs against the tangent that is given at node {}; tangents point along the curve in "
                       "the order of its nodes",
                       against_tangent),
           {{Remedy::rules, "give the tangent the other sense"}}});
    }
    if (!tolerance) {
      report.smoothing_length = curve.found.smoothing / input.scale();
      warn_if_left_behind(report, input.points().positions);
      return;
    }
    if (measures.figure(result.distances) > curve.leeway * *tolerance) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back({WarningCode::outside_tolerance, outside(result, *tolerance)});
    } else if (curve.way_beyond > little_beyond) {
      fair.outcome = Outcome::stalled;
      fair.warnings.push_back(
          {WarningCode::outside_tolerance,
           fmt::format("all points are within {:g} of the shape, but it goes {:.4g} away from the line through them; "
                       "put the rows in order, leave out what is off, or allow more",
                       *tolerance, report.shape.greatest)});
    } else if (!curve.found.converged && !is_sharp) {
      fair.warnings.push_back(
          {WarningCode::maybe_not_fairest, "the shape is within the tolerance, but may not be the fairest"});
    }
  }

  /// The message about points that are further away than the tolerance.
  [[nodiscard]] std::string outside(const FitResult& result, double tolerance) const {
    if (!input.options().within())
      return fmt::format(
          "no shape within {:g} was found: this is the nearest; points lie at what is held, or edges "
          "are too long",
          tolerance);
    std::vector<double> distances = result.distances;
    const std::vector<std::uint8_t> counting = measures.counting(distances, input.kept());
    for (std::size_t j = 0; j < distances.size(); ++j) distances[j] *= counting[j];
    const auto point =
        static_cast<std::size_t>(std::max_element(distances.begin(), distances.end()) - distances.begin());
    return fmt::format("no shape within {:g} was found: this is the nearest; point {} is {:.4g} away{}", tolerance,
                       point, distances[point],
                       measures.is_at_held(point, distances[point], curve.nodes)
                           ? ", and nearest to a node that is held: do not hold that, or allow more"
                           : ": edges are too long there, or what is held is near");
  }
};

}  // namespace

FitResult result_of(const CurveFitInput& input, const CurveMeasures& measures, const FittedCurve& curve,
                    std::vector<Vector3> positions, const Resampled& nodes, const Context& context) {
  const PolygonCurve& shape = nodes.curve;
  const Constraints& constraints = nodes.constraints;
  FitResult result;
  FitReport& report = result.report;
  FairReport& fair = report.fair;
  fair.method = Method::equilibrium;
  fair.threads = context.thread_count();
  fair.warnings = input.warnings();
  fair.iterations = curve.found.steps;
  fair.nodes = shape.node_count();
  for (Index i = 0; i < fair.nodes; ++i) {
    ++(constraints.position_fixed(i) ? fair.fixed_positions : fair.moving_nodes);
    fair.fixed_normals += constraints.normal_fixed(i) ? 1 : 0;
    fair.fixed_tangents += tangents_given(constraints, i);
  }
  result.positions = std::move(positions);
  PolygonCurve moved = shape;
  moved.set_positions(result.positions);
  const auto& kept = input.kept();
  result.distances = measures.distances(moved);
  const std::vector<double>& before = measures.distances_before();
  report.before = summary(before, measures.counting(before, input.counted()));
  const std::vector<std::uint8_t> counting = measures.counting(result.distances, kept);
  report.after = summary(result.distances, counting);
  const FitOptions& options = input.options();
  tell_points_at_held(kept, counting, options.tolerance(), result);
  if (options.tolerance()) report.outside_points = count_beyond(result.distances, counting, *options.tolerance());
  if (options.within()) report.active_points = active_points(result.distances, counting, *options.within());
  report.shape = measures.way_off(moved);
  if (input.own_nodes() && curve.nodes.from.empty()) report.greatest_slide = measures.greatest_slide(moved);
  report.points = static_cast<Index>(std::count(input.counted().begin(), input.counted().end(), 1));
  report.outlying_points = left_out(input.counted(), kept);
  report.outliers = static_cast<Index>(report.outlying_points.size());
  report.pulling_points = input.pulling_points();
  report.pulled_nodes = input.pulled_nodes();
  report.most_points = input.most_points();
  const std::vector<std::uint8_t> corners = measures.corners(nodes);
  fair.corners = static_cast<Index>(std::count(corners.begin(), corners.end(), 1));
  const Index against = node_against_tangent(moved, constraints);
  Conclusion{input, measures, curve, against}.add(result, measures.sharpest(moved, nodes), context.cancelled());
  return result;
}

}  // namespace vspring
