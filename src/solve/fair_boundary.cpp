#include "solve/fair_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include "constraints/holding.hpp"
#include "curve_fit/way_corners.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

// Of a boundary that is fitted: corners turn by more than this, on stretches of so many edges at least, and so many
// times the noise tell nothing.
constexpr double least_turn_of_corner = std::numbers::pi / 3;
constexpr int least_edges_to_corner = 2;
constexpr double times_noise = 3;

struct BoundaryTask {
  PolygonCurve curve;
  Constraints of_curve;
  Constraints of_surface;   ///< with all of the boundary held
  std::vector<Index> free;  ///< boundary nodes that move as a curve
};

BoundaryTask boundary_task(const PolygonMesh& mesh, const Constraints& constraints) {
  BoundaryTask task{boundary_curve(mesh), Constraints(mesh.node_count()), constraints, {}};
  const std::vector<std::uint8_t> on_boundary = boundary_nodes(mesh);
  std::vector<int> passed(on_boundary.size(), 0);
  for (const auto& chain : task.curve.chains()) {
    for (const Index node : chain.nodes) ++passed[static_cast<std::size_t>(node)];
  }
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (on_boundary[static_cast<std::size_t>(i)] == 0) continue;
    if (passed[static_cast<std::size_t>(i)] > 1 && !constraints.position_fixed(i)) {
      // Loops meet there.
      task.of_curve.fix_position(i, mesh.position(i));
      task.of_surface.fix_position(i, mesh.position(i));
      continue;
    }
    if (constraints.position_fixed(i)) task.of_curve.fix_position(i, constraints.position(i));
    if (constraints.tangent_fixed(i)) task.of_curve.fix_tangent(i, constraints.tangent(i));
    if (!constraints.position_fixed(i)) task.free.push_back(i);
  }
  return task;
}

void hold(BoundaryTask& task, const std::vector<Vector3>& positions) {
  for (const Index i : task.free) task.of_surface.fix_position(i, positions[static_cast<std::size_t>(i)]);
}

/// Goes the share `strength` of the way from the input, and tells of that way.
void account_for_moves(const PolygonMesh& mesh, const Constraints& constraints, double strength,
                       std::vector<Vector3>& positions, FairReport& report) {
  std::vector<double> moves;
  report.fixed_positions = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    Vector3& position = positions[static_cast<std::size_t>(i)];
    if (constraints.position_fixed(i)) ++report.fixed_positions;
    if (constraints.position_fixed(i) || position == mesh.position(i)) continue;
    const Vector3 move = strength * (position - mesh.position(i));
    if (strength < 1) position = mesh.position(i) + move;
    moves.push_back(move.stableNorm());
  }
  report.moving_nodes = static_cast<Index>(moves.size());
  report.greatest_move = moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
  report.rms_move = 0;
  if (!(report.greatest_move > 0)) return;
  double squares = 0;
  for (const double move : moves) squares += move / report.greatest_move * (move / report.greatest_move);
  report.rms_move = report.greatest_move * std::sqrt(squares / static_cast<double>(moves.size()));
}

/// How far from where they belong nodes may be, by what is to be taken off; 0 where that is not known.
double reach_of_noise(const FitOptions& options) {
  if (options.within()) return *options.within();
  return times_noise * options.noise().value_or(options.rms().value_or(0));
}

/// Corners of loops whose nodes are not held in a direction stay corners: they are more than noise.
void keep_corners(const std::vector<PolygonCurve::Chain>& loops, const std::vector<Vector3>& positions, double reach,
                  Constraints& constraints) {
  for (const auto& loop : loops) {
    std::vector<Vector3> way;
    for (const Index node : loop.nodes) way.push_back(positions[static_cast<std::size_t>(node)]);
    for (const std::size_t k :
         corners_of_way(way, loop.closed, least_turn_of_corner, reach, {}, least_edges_to_corner)) {
      if (!constraints.tangent_fixed(loop.nodes[k])) constraints.make_corner(loop.nodes[k]);
    }
  }
}

/// Says of the surface what is to be said of its boundary.
void join(FairReport boundary, FairReport& report) {
  if (report.outcome == Outcome::converged) report.outcome = boundary.outcome;
  report.warnings.insert(report.warnings.begin(), boundary.warnings.begin(), boundary.warnings.end());
  report.boundary = std::make_shared<const FairReport>(std::move(boundary));
}

}  // namespace

FairResult fair_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, FairOptions options,
                               Context& context) {
  BoundaryTask task = boundary_task(mesh, constraints);
  // What the surface would be refused for comes before the work on its boundary.
  hold(task, mesh.positions());
  (void)check_constraints(mesh, task.of_surface, {});

  const double strength = std::exchange(options.strength, 1);
  FairOptions curve_options = options;
  curve_options.method = *options.fair_boundary;
  options.fair_boundary.reset();
  FairResult curve = fair(task.curve, task.of_curve, curve_options, context);
  hold(task, curve.positions);
  PolygonMesh bounded = mesh;
  bounded.set_positions(std::move(curve.positions));
  FairResult result = fair(bounded, task.of_surface, options, context);

  FairReport& report = result.report;
  join(std::move(curve.report), report);
  account_for_moves(mesh, constraints, strength, result.positions, report);
  return result;
}

FitResult fit_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                             FitOptions options, Context& context) {
  if (points.positions != mesh.positions())
    throw Error(ErrorCode::invalid_argument,
                "the boundary can be fitted first only where the points are the nodes of the shape; else fair it "
                "before, and hold it");
  options.fair.fair_boundary.reset();
  BoundaryTask task = boundary_task(mesh, constraints);
  if (task.free.empty()) return fit(mesh, constraints, points, options, context);
  hold(task, mesh.positions());
  (void)check_constraints(mesh, task.of_surface, std::vector<std::uint8_t>(mesh.positions().size(), 1));

  FitOptions of_curve = options;
  // Across a curve in space noise has two directions.
  if (const auto noise = options.rms() ? options.rms() : options.noise())
    of_curve.criterion = RootMeanSquare{std::sqrt(2.0) * *noise};
  // The nodes of the boundary alone: they are the points.
  std::vector<Index> node_of;
  std::vector<PolygonCurve::Chain> chains = task.curve.chains();
  ScatteredPoints on_curve;
  for (auto& chain : chains) {
    for (Index& node : chain.nodes) {
      node_of.push_back(node);
      on_curve.positions.push_back(mesh.position(node));
      if (!points.weights.empty()) on_curve.weights.push_back(points.weights[static_cast<std::size_t>(node)]);
      node = static_cast<Index>(node_of.size() - 1);
    }
  }
  Constraints held(static_cast<Index>(node_of.size()));
  for (std::size_t k = 0; k < node_of.size(); ++k) {
    held.hold_as(static_cast<Index>(k), task.of_curve, node_of[k]);
  }
  if (const double reach = reach_of_noise(options); reach > 0) keep_corners(chains, on_curve.positions, reach, held);
  FitResult curve = fit(PolygonCurve(on_curve.positions, std::move(chains)), held, on_curve, of_curve, context);
  std::vector<Vector3> positions = mesh.positions();
  for (std::size_t k = 0; k < node_of.size(); ++k) positions[static_cast<std::size_t>(node_of[k])] = curve.positions[k];
  hold(task, positions);
  FitResult result = fit(mesh, task.of_surface, points, options, context);
  join(std::move(curve.report.fair), result.report.fair);
  account_for_moves(mesh, constraints, 1, result.positions, result.report.fair);
  return result;
}

}  // namespace vspring
