#include "solve/sharp_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "constraints/holding.hpp"
#include "shape/corners.hpp"
#include "shape/sharp_edges.hpp"
#include "solve/chains_at_folds.hpp"
#include "solve/more_folds.hpp"
#include "vspring/corners.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

// Degrees: nodes at which a chain turns by more are corners of it.
constexpr double turn_of_corner = 60;

/// Constraints that suit the mesh, and hold the chains that stay.
Constraints with_chains_held(const PolygonMesh& mesh, Constraints constraints, const SharpEdges& sharp,
                             SharpCurves curves) {
  if (constraints.node_count() != mesh.node_count()) (void)check_constraints(mesh, constraints);
  refuse_corners(constraints);
  if (curves == SharpCurves::fit) return constraints;
  const PlacesOnSupports places(mesh.positions(), constraints);
  for (const Index node : nodes_of(sharp.edges)) {
    if (!constraints.position_fixed(node)) constraints.fix_position(node, places(node, mesh.position(node)));
  }
  return constraints;
}

PolygonCurve lines_of(const PolygonMesh& mesh, const SharpEdges& sharp, SharpCurves curves, bool with_boundary) {
  std::vector<PolygonCurve::Chain> chains;
  if (curves == SharpCurves::fit) chains = sharp.chains.chains();
  if (with_boundary) {
    std::vector<std::uint8_t> ends(mesh.positions().size(), 0);
    for (const Index node : nodes_of(sharp.edges)) ends[static_cast<std::size_t>(node)] = 1;
    const PolygonCurve boundary = cut_at_corners(boundary_curve(mesh), ends);
    chains.insert(chains.end(), boundary.chains().begin(), boundary.chains().end());
  }
  return {mesh.positions(), std::move(chains)};
}

}  // namespace

SharpSides::SharpSides(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                       SharpCurves curves, bool with_boundary)
    : mesh_(&mesh),
      sharp_(as_sharp_edges(mesh, options.sharp_edges)),
      constraints_(with_chains_held(mesh, constraints, sharp_, curves)),
      fixes_normals_(options.fix_sharp_normals),
      chains_(curves == SharpCurves::fit ? sharp_.chains.chains().size() : 0),
      lines_(mesh, constraints_, lines_of(mesh, sharp_, curves, with_boundary)),
      cut_(into_sheets(mesh, nodes_of(sharp_.edges), sharp_.edges)) {}

std::vector<Index> SharpSides::nodes_with_copies() const {
  std::vector<Index> nodes = cut_.origin;
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Constraints SharpSides::held() const {
  Constraints held = lines_.of_surface;
  for (const Index node : nodes_with_copies()) held.free_normal(node);
  const Index nodes = mesh_->node_count();
  const auto copies = static_cast<Index>(cut_.origin.size());
  held.add_nodes(copies);
  for (Index k = 0; k < copies; ++k) held.hold_as(nodes + k, held, cut_.origin[static_cast<std::size_t>(k)]);
  if (!fixes_normals_) return held;
  std::vector<Index> at = nodes_with_copies();
  for (Index k = 0; k < copies; ++k) at.push_back(nodes + k);
  const std::vector<Vector3> normals = estimate_normals(cut_.mesh, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (!normals[k].isZero(0)) held.fix_normal(at[k], normals[k]);
  }
  return held;
}

std::vector<Vector3> SharpSides::positions(std::vector<Vector3> of_mesh) const {
  of_mesh.reserve(cut_.mesh.positions().size());
  for (const Index node : cut_.origin) of_mesh.push_back(of_mesh[static_cast<std::size_t>(node)]);
  return of_mesh;
}

void SharpSides::join_sides(double strength, std::vector<Vector3>& positions, FairReport& report) const {
  positions.resize(mesh_->positions().size());
  account_for_moves(*mesh_, constraints_, strength, positions, report);
  report.nodes = mesh_->node_count();
  report.fixed_normals = 0;
  Index left_out = 0;
  for (Index i = 0; i < mesh_->node_count(); ++i) report.fixed_normals += constraints_.normal_fixed(i) ? 1 : 0;
  for (const Index node : nodes_with_copies()) left_out += constraints_.normal_fixed(node) ? 1 : 0;
  report.fixed_normals -= left_out;
  report.sharp_edges = static_cast<Index>(sharp_.edges.size());
  if (left_out == 0) return;
  report.warnings.push_back(
      {WarningCode::normals_at_sharp_edges,
       fmt::format("{} given normal{} at nodes of sharp edges {} left out: each side has its own there", left_out,
                   left_out == 1 ? "" : "s", left_out == 1 ? "is" : "are")});
}

bool SharpSides::is_worse(const std::vector<Vector3>& positions, const FairOptions& options,
                          const Context& context) const {
  return !options.accept_worse && !context.cancelled() && has_more_folds(*mesh_, positions, sharp_.edges, context);
}

void tell_that_edges_stay(FairReport& report) {
  report.warnings.push_back(
      {WarningCode::worse_than_input,
       "the sharp edges stay where they were, as the surface would fold or cross itself more with them elsewhere"});
}

void tell_that_it_is_worse(FairReport& report) {
  if (report.outcome == Outcome::converged) report.outcome = Outcome::worse_than_input;
  report.warnings.push_back(
      {WarningCode::worse_than_input,
       "what was found is worse than the input: it has more folds or faces that cross, as its lines have moved"});
}

namespace {

/// The sharp edges at whose chains the surface folds.
std::size_t edges_at_folds(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const FairOptions& options,
                           const Context& context, const FairReport& report) {
  if (options.accept_worse || context.cancelled() || report.outcome != Outcome::converged) return 0;
  return chains_at_folds(mesh, positions, options.sharp_edges).size();
}

void tell_that_normals_stay(std::size_t edges, FairReport& report) {
  report.warnings.push_back({WarningCode::sharp_normals_kept,
                             fmt::format("sides keep their tangent planes at sharp edges: if they turned freely, the "
                                         "surface would fold at chains of {} of {} of them",
                                         edges, report.sharp_edges)});
}

void tell_of_folds(std::size_t edges, FairReport& report) {
  report.outcome = Outcome::worse_than_input;
  report.warnings.push_back(
      {WarningCode::worse_than_input,
       fmt::format("what was found is worse than the input: it folds at chains of {} of {} sharp edges", edges,
                   report.sharp_edges),
       {{Remedy::input, "take fewer edges"}, {Remedy::noise, "take noise off first"}}});
}

}  // namespace

FairResult fair_sharp_sides(const PolygonMesh& mesh, const Constraints& constraints, FairOptions options,
                            Context& context) {
  const FairOptions given = options;
  const SharpCurves sharp_curves = options.sharp_curves.value_or(SharpCurves::hold);
  SharpSides sides(mesh, constraints, options, sharp_curves, options.fair_boundary.has_value());
  LinesOfSurface& lines = sides.lines();
  options.sharp_edges.clear();
  const double strength = std::exchange(options.strength, 1);
  const auto of_boundary = std::exchange(options.fair_boundary, std::nullopt);
  std::vector<Vector3> start = mesh.positions();
  std::shared_ptr<const FairReport> of_lines;
  if (!lines.free.empty()) {
    for (const Index node : find_corners(lines.curve, turn_of_corner)) {
      if (!lines.of_curve.position_fixed(node) && !lines.of_curve.tangent_fixed(node)) lines.of_curve.make_corner(node);
    }
    FairOptions of_curves = options;
    of_curves.continuity = Continuity::tangent;
    if (of_boundary) of_curves.method = *of_boundary;
    FairResult curves = fair(lines.curve, lines.of_curve, of_curves, context);
    lines.hold(curves.positions);
    start = std::move(curves.positions);
    of_lines = std::make_shared<const FairReport>(std::move(curves.report));
  }
  PolygonMesh cut = sides.cut().mesh;
  cut.set_positions(sides.positions(std::move(start)));
  FairResult result = fair(cut, sides.held(), options, context);
  sides.join_sides(strength, result.positions, result.report);
  if (const std::size_t edges = edges_at_folds(mesh, result.positions, given, context, result.report); edges > 0) {
    if (!given.fix_sharp_normals) {
      options = given;
      options.fix_sharp_normals = true;
      FairResult held = fair_sharp_sides(mesh, constraints, options, context);
      tell_that_normals_stay(edges, held.report);
      return held;
    }
    tell_of_folds(edges, result.report);
  }
  if (!of_lines) return result;
  join(*of_lines, result.report);
  result.report.sharp_curves = of_lines;
  if (of_boundary) result.report.boundary = of_lines;
  if (!sides.is_worse(result.positions, given, context)) return result;
  if (sharp_curves == SharpCurves::hold) {
    tell_that_it_is_worse(result.report);
    return result;
  }
  options = given;
  options.sharp_curves = SharpCurves::hold;
  FairResult held = fair_sharp_sides(mesh, constraints, options, context);
  tell_that_edges_stay(held.report);
  return held;
}

}  // namespace vspring
