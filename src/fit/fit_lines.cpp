#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "base/cancellation.hpp"
#include "base/threads.hpp"
#include "checks/new_crossings.hpp"
#include "constraints/holding.hpp"
#include "constraints/immovable_nodes_fixed.hpp"
#include "fit/boundary_trace.hpp"
#include "fit/kinds_of_fit.hpp"
#include "fit/lines_at_nodes.hpp"
#include "fit/measure_again.hpp"
#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"
#include "shape/sheets.hpp"
#include "shape/turned_edges.hpp"
#include "solve/lines_of_surface.hpp"
#include "solve/more_folds.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

// Rings of neighbours that move along with lines; each node moves about like the mean of its neighbours, after so many
// turns.
constexpr int rings_along = 4;
constexpr int turns_along = 20;
// The share of a tolerance that a boundary at scattered points uses.
constexpr double share_of_boundary = 0.5;
// Doublings of its smoothing length.
constexpr int most_doublings = 10;

/// Positions of all nodes on lines as a fit has left them: nodes near a line move along, so that they do not end on its
/// other side.
std::vector<Vector3> with_lines(const PolygonMesh& mesh, const Constraints& constraints, const LinesOfSurface& lines) {
  const Incidence incidence(mesh);
  const NodeGraph graph(mesh, incidence);
  std::vector<Vector3> moves(mesh.positions().size(), Vector3::Zero());
  std::vector<std::uint8_t> is_near(moves.size(), 0);
  std::vector<Index> near = lines.free;
  for (const Index i : near) {
    moves[static_cast<std::size_t>(i)] = lines.of_surface.position(i) - mesh.position(i);
    is_near[static_cast<std::size_t>(i)] = 1;
  }
  std::size_t done = 0;
  for (int ring = 0; ring < rings_along; ++ring) {
    for (const std::size_t end = near.size(); done < end; ++done) {
      graph.for_each_neighbour(near[done], [&](Index j) {
        if (std::exchange(is_near[static_cast<std::size_t>(j)], 1) == 0 && !constraints.position_fixed(j))
          near.push_back(j);
      });
    }
  }
  // Each the mean of its neighbours, about.
  for (int turn = 0; turn < turns_along; ++turn) {
    for (std::size_t k = lines.free.size(); k < near.size(); ++k) {
      Vector3 sum = Vector3::Zero();
      int neighbours = 0;
      graph.for_each_neighbour(near[k], [&](Index j) {
        sum += moves[static_cast<std::size_t>(j)];
        ++neighbours;
      });
      moves[static_cast<std::size_t>(near[k])] = sum / neighbours;
    }
  }
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i] += mesh.positions()[i];
  return moves;
}

/// Makes a boundary that lies at scattered points fair, with a smoothing length: that of the surface or, for a
/// tolerance, one by which it moves no further than half of that, so that the nodes beside it can still move. of_edges:
/// the length by which it is smooth already. The surface then holds it.
FitResult fair_traced_boundary(const PolygonMesh& mesh, LinesOfSurface& boundary, double of_edges, FitOptions options,
                               Context& context) {
  options.outliers = 0;
  options.fair.distribution = Distribution::keep;
  const auto tolerance = options.tolerance();
  if (!tolerance) return fit_lines(mesh, boundary, {}, options_of_lines(options), context);
  std::optional<FitResult> fairest;
  for (int doublings = 0; doublings < most_doublings; ++doublings) {
    FitOptions smoothed = options;
    smoothed.criterion = SmoothingLength{std::ldexp(of_edges, doublings)};
    FitResult found = fit_lines(mesh, boundary, {}, options_of_lines(smoothed), context);
    const Distance& off = found.report.after.all;
    const bool is_near = (options.within() ? off.greatest : off.rms) <= share_of_boundary * *tolerance;
    if (fairest && !(is_near && found.report.fair.outcome == Outcome::converged)) break;
    fairest = std::move(found);
  }
  boundary.hold(fairest->positions);
  return *std::move(fairest);
}

void warn_of_kept(const std::vector<Index>& kept, std::size_t free, FairReport& report) {
  if (kept.empty()) return;
  report.warnings.push_back(
      {WarningCode::untold_boundary,
       fmt::format("{} of {} free boundary nodes stay where they were, node {} first: no points are within two edges, "
                   "or they do not tell where the boundary is",
                   kept.size(), free, kept.front()),
       {{Remedy::input, "bring the shape nearer"}, {Remedy::fix_boundary, "fix the boundary"}}});
}

/// The boundary is drawn to where scattered points end, made fair, and held; where that would make the surface worse,
/// it stays where it was.
FitResult fit_traced_boundary(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                              LinesOfSurface boundary, FitOptions options, Context& context) {
  const FitOptions given = options;
  const double strength = std::exchange(options.fair.strength, 1);
  const Constraints at_home = boundary.of_surface;
  TracedBoundary traced;
  try {
    traced = trace_boundary(mesh, boundary, points, options.boundary_reach, context);
  } catch (const Cancelled&) {
    return fit_as_asked(mesh, boundary.of_surface, points, options, context);
  }
  PolygonMesh at_points = mesh;
  at_points.set_positions(traced.positions);
  for (const Index node : traced.corners) boundary.of_curve.make_corner(node);
  for (const Index node : traced.held) boundary.fix(node, at_points.position(node));
  boundary.hold(traced.positions);
  std::optional<FairReport> of_curve;
  if (traced.held.size() < boundary.free.size()) {
    boundary.move_to(traced.positions);
    of_curve = fair_traced_boundary(at_points, boundary, traced.smoothing, options, context).report.fair;
  }
  PolygonMesh start = mesh;
  start.set_positions(with_lines(mesh, constraints, boundary));
  FitResult result = fit_as_asked(start, boundary.of_surface, points, options, context);
  if (!given.fair.accept_worse && !context.cancelled()) {
    const bool folds = has_more_folds(mesh, result.positions, {}, context);
    if (folds || result.report.fair.outcome == Outcome::worse_than_input) {
      FitResult where_it_was = fit_as_asked(mesh, at_home, points, given, context);
      if (folds || where_it_was.report.fair.outcome != Outcome::worse_than_input) {
        where_it_was.report.boundary =
            BoundaryOfPoints{.points = traced.told.points, .kept = static_cast<Index>(boundary.free.size())};
        where_it_was.report.fair.warnings.push_back(
            {WarningCode::untold_boundary,
             "the boundary stays where it was, as the surface would be worse with it where the points end",
             {{Remedy::input, "bring the shape nearer"}, {Remedy::fix_boundary, "fix the boundary"}}});
        return where_it_was;
      }
    }
  }
  FairReport& report = result.report.fair;
  warn_of_kept(traced.kept, boundary.free.size(), report);
  if (of_curve) {
    join(*of_curve, report);
    report.boundary = std::make_shared<const FairReport>(*std::move(of_curve));
  }
  result.report.boundary = traced.told;
  account_for_moves(mesh, constraints, strength, result.positions, report);
  measure_again_at_boundary(mesh, constraints, start, boundary.of_surface, points, given, result, context.threads);
  return result;
}

}  // namespace

FitResult fit_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                             FitOptions options, Context& context) {
  LinesOfSurface boundary(mesh, constraints, boundary_curve(mesh));
  options.fair.fair_boundary.reset();
  const bool are_nodes = points.positions == mesh.positions();
  const bool tell_nothing = !are_nodes && options.weight() && !(*options.weight() > 0);
  if (boundary.free.empty() || tell_nothing) return fit_as_asked(mesh, constraints, points, options, context);
  if (!are_nodes && !std::holds_alternative<EquilibriumMethod>(options.fair.method))
    throw Error(ErrorCode::invalid_argument,
                "the boundary can be fitted to scattered points by the method equilibrium only",
                {{Remedy::fix_boundary, "fix the boundary"}});
  boundary.hold(mesh.positions());
  (void)check_constraints(mesh, boundary.of_surface, std::vector<std::uint8_t>(mesh.positions().size(), 1));
  if (!are_nodes) return fit_traced_boundary(mesh, constraints, points, std::move(boundary), options, context);

  keep_corners(boundary, options);
  FitResult curve = fit_lines(mesh, boundary, points.weights, options_of_lines(options), context);
  FitResult result = fit_as_asked(mesh, boundary.of_surface, points, options, context);
  FairReport& report = result.report.fair;
  join(curve.report.fair, report);
  report.boundary = std::make_shared<const FairReport>(std::move(curve.report.fair));
  account_for_moves(mesh, constraints, 1, result.positions, report);
  if (!result.distances.empty()) measure_again(mesh, constraints, options, result, context.threads);
  return result;
}

namespace {

/// Fits the sheets of a surface, cut where they meet.
class SheetFit {
 public:
  SheetFit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
           const FitOptions& options, Context& context, const FitOfSheets& fit)
      : mesh_(mesh), constraints_(constraints), points_(points), options_(options), context_(context), fit_(fit) {}

  FitResult run() {
    FitResult result = fit_on_lines(true);
    if (!of_lines_ || result.report.fair.outcome == Outcome::cancelled) return result;
    // Looked at by fit() beside a start on new lines, and not beside the mesh.
    if (is_worse(result)) return fit_on_lines(false);
    FairReport& report = result.report.fair;
    join(*of_lines_, report);
    account_for_moves(mesh_, constraints_, 1, result.positions, report);
    if (!result.distances.empty()) measure_again(mesh_, constraints_, options_, result, context_.threads);
    return result;
  }

 private:
  FitResult fit_on_lines(bool fits_lines) {
    start_ = mesh_.positions();
    ImmovableNodesFixed immovable(
        mesh_, [&](const Constraints& held) { return fits_lines ? places(held) : mesh_.positions(); });
    FitResult result = immovable.run(
        constraints_, [&](const PolygonMesh& sheets, const Constraints& held) { return fit(sheets, held); });
    immovable.join_sheets(constraints_, result.positions, result.report.fair);
    return result;
  }

  [[nodiscard]] bool is_worse(const FitResult& result) const {
    ThreadTeam team(context_.thread_count());
    return result.report.fair.outcome == Outcome::worse_than_input ||
           !TurnedEdges(mesh_).faces(result.positions).empty() || loses_area(mesh_, result.positions) ||
           !new_crossings(mesh_, result.positions, context_, team).empty();
  }

  [[nodiscard]] bool pull_at_home() const { return points_.positions == mesh_.positions(); }

  /// Where nodes that cannot move are held; makes the start.
  std::vector<Vector3> places(const Constraints& held) {
    if (!pull_at_home() || !std::holds_alternative<EquilibriumMethod>(options_.fair.method)) return start_;
    LinesOfSurface lines(mesh_, held, junction_lines(mesh_));
    if (lines.free.empty()) return start_;
    keep_corners(lines, options_);
    FitResult curve = fit_lines(mesh_, lines, points_.weights, options_of_lines(options_), context_);
    const Outcome outcome = curve.report.fair.outcome;
    if (outcome == Outcome::worse_than_input || outcome == Outcome::cancelled) return start_;
    of_lines_ = std::move(curve.report.fair);
    start_ = with_lines(mesh_, held, lines);
    return start_;
  }

  FitResult fit(PolygonMesh sheets, const Constraints& held) const {
    const std::size_t count = sheets.positions().size();
    if (!pull_at_home() || count == mesh_.positions().size()) return fit_(sheets, held, points_);
    ScatteredPoints more = points_;
    more.positions = start_;
    for (std::size_t i = start_.size(); i < count; ++i) more.positions.push_back(held.position(static_cast<Index>(i)));
    sheets.set_positions(more.positions);
    if (more.weights.empty()) more.weights.assign(points_.positions.size(), 1);
    more.weights.resize(count, 0);
    if (!more.normals.empty()) more.normals.resize(count, Vector3::Zero());
    FitResult result = fit_(sheets, held, more);
    if (!result.distances.empty()) result.distances.resize(points_.positions.size());
    result.report.points = static_cast<Index>(points_.positions.size());
    return result;
  }

  const PolygonMesh& mesh_;
  const Constraints& constraints_;
  const ScatteredPoints& points_;
  const FitOptions& options_;
  Context& context_;
  const FitOfSheets& fit_;
  std::optional<FairReport> of_lines_;  ///< where they have been fitted
  std::vector<Vector3> start_;
};

}  // namespace

FitResult fit_sheets(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                     const FitOptions& options, Context& context, const FitOfSheets& fit) {
  return SheetFit(mesh, constraints, points, options, context, fit).run();
}

}  // namespace vspring
