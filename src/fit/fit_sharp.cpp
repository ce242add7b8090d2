#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fit/kinds_of_fit.hpp"
#include "fit/lines_at_nodes.hpp"
#include "fit/measure_again.hpp"
#include "fit/side_places.hpp"
#include "shape/sharp_edges.hpp"
#include "solve/chains_at_folds.hpp"
#include "solve/sharp_sides.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// Share of the deviation that is left where the sides give the places: neighbours have the same errors.
constexpr double share_of_deviation = 0.7;

/// The nodes of all sides as points; copies have no weight, as they are held where the node is.
ScatteredPoints points_of_sides(const SharpSides& sides, const ScatteredPoints& nodes) {
  ScatteredPoints more = nodes;
  const std::size_t count = sides.cut().mesh.positions().size();
  more.positions = sides.cut().mesh.positions();
  if (more.weights.empty()) more.weights.assign(nodes.positions.size(), 1);
  more.weights.resize(count, 0);
  if (!more.normals.empty()) more.normals.resize(count, Vector3::Zero());
  return more;
}

/// The reports on fitted lines: chains, and the boundary where that was fitted by itself.
struct FittedLines {
  FairReport report;
  std::optional<FairReport> boundary;
};

/// Fits the lines to their own nodes. Where noise is taken off, chains and corners are fitted to where the sides meet;
/// nodes of the boundary have all of the noise.
FittedLines fit_to_sides(const PolygonMesh& mesh, Constraints constraints, SharpSides& sides,
                         const std::vector<double>& weights, const FitOptions& options, Context& context) {
  LinesOfSurface& lines = sides.lines();
  PolygonMesh at_places = mesh;
  FitOptions of_lines = options_of_lines(options);
  if (const auto noise = options.noise() ? options.noise() : options.rms()) {
    SidePlaces places = places_by_sides(mesh, sides.cut().mesh, sides.cut().origin, *noise);
    at_places.set_positions(std::move(places.positions));
    lines.move_to(at_places.positions());
    of_lines.criterion = Noise{share_of_deviation * places.deviation};
    for (const Index node : places.corners) {
      if (constraints.position_fixed(node)) continue;
      constraints.fix_position(node, at_places.position(node));
      lines.fix(node, at_places.position(node));
    }
  }
  keep_corners(lines, options);
  const std::size_t all = lines.curve.chains().size();
  const bool apart = of_lines.noise().has_value();
  std::vector<LinesAlike> groups;
  const auto add = [&](std::size_t begin, std::size_t end, const FitOptions& how) {
    if (begin < end) groups.push_back({begin, end, how});
  };
  add(0, apart ? sides.chains() : all, of_lines);
  add(apart ? sides.chains() : all, all, options_of_lines(options));
  place_ends(at_places, constraints, lines, weights, groups, context);
  std::optional<FittedLines> found;
  for (const LinesAlike& which : groups) {
    FairReport report = fit_lines(at_places, lines, weights, which, context).report.fair;
    if (found)
      found->boundary = std::move(report);
    else
      found = FittedLines{std::move(report), {}};
  }
  return *std::move(found);
}

/// A fit with sharp edges, and those with which it has folds or is worse than the input although its noise is off.
struct FittedSides {
  FitResult result;
  MeshEdges at_folds;
};

FittedSides fit_sides(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                      FitOptions options, Context& context) {
  options.validate();
  if (options.voxels())
    throw Error(ErrorCode::invalid_argument, "steps of voxels are no sharp edges: leave these out, or give the noise");
  const bool are_nodes = points.positions == mesh.positions();
  const SharpCurves curves = options.fair.sharp_curves.value_or(are_nodes ? SharpCurves::fit : SharpCurves::hold);
  if (!are_nodes && curves == SharpCurves::fit)
    throw Error(ErrorCode::invalid_argument,
                "scattered points do not say which of them lie on sharp edges; hold these");
  // Scattered points draw the boundary of the sides.
  const bool with_boundary =
      are_nodes && (options.fair.fair_boundary.has_value() || slides_at_boundary(mesh, constraints));
  const FitOptions given = options;
  SharpSides sides(mesh, constraints, options.fair, curves, with_boundary);
  options.fair.sharp_edges.clear();
  if (with_boundary) options.fair.fair_boundary.reset();
  const double strength = std::exchange(options.fair.strength, 1);
  LinesOfSurface& lines = sides.lines();
  std::optional<FittedLines> of_lines;
  if (!lines.free.empty()) of_lines = fit_to_sides(mesh, constraints, sides, points.weights, options, context);
  FitResult result = are_nodes ? fit(sides.cut().mesh, sides.held(), points_of_sides(sides, points), options, context)
                               : fit(sides.cut().mesh, sides.held(), points, options, context);
  FitReport& report = result.report;
  if (are_nodes && !result.distances.empty()) result.distances.resize(points.positions.size());
  report.points = static_cast<Index>(points.positions.size());
  MeshEdges at_folds;
  if (options.noise() && curves == SharpCurves::fit && !context.cancelled()) {
    std::vector<Vector3> found = result.positions;
    found.resize(mesh.positions().size());
    at_folds = chains_at_folds(mesh, found, given.fair.sharp_edges);
    if (at_folds.empty() && report.fair.outcome == Outcome::worse_than_input) at_folds = given.fair.sharp_edges;
  }
  sides.join_sides(strength, result.positions, report.fair);
  if (!result.distances.empty()) {
    if (are_nodes)
      measure_again(mesh, constraints, options, result, context.threads);
    else if (strength < 1)
      measure_again(mesh, constraints, points, options, result, context.threads);
  }
  if (!of_lines || !at_folds.empty()) return {std::move(result), std::move(at_folds)};
  if (sides.is_worse(result.positions, given.fair, context)) {
    if (curves == SharpCurves::fit) {
      options = given;
      options.fair.sharp_curves = SharpCurves::hold;
      FittedSides held = fit_sides(mesh, constraints, points, options, context);
      tell_that_edges_stay(held.result.report.fair);
      if (given.noise() && held.result.report.fair.outcome == Outcome::worse_than_input)
        held.at_folds = given.fair.sharp_edges;
      return held;
    }
    tell_that_it_is_worse(report.fair);
  }
  if (of_lines->boundary) join(*of_lines->boundary, report.fair);
  join(of_lines->report, report.fair);
  report.fair.sharp_curves = std::make_shared<const FairReport>(std::move(of_lines->report));
  if (of_lines->boundary)
    report.fair.boundary = std::make_shared<const FairReport>(*std::move(of_lines->boundary));
  else if (with_boundary)
    report.fair.boundary = report.fair.sharp_curves;
  return {std::move(result), {}};
}

}  // namespace

FitResult fit_sharp_sides(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                          FitOptions options, Context& context) {
  MeshEdges& sharp = options.fair.sharp_edges;
  MeshEdges rounded;
  sharp = as_sharp_edges(mesh, sharp).edges;
  const std::size_t all = sharp.size();
  FittedSides fitted = fit_sides(mesh, constraints, points, options, context);
  while (!fitted.at_folds.empty()) {
    MeshEdges left;
    std::set_difference(sharp.begin(), sharp.end(), fitted.at_folds.begin(), fitted.at_folds.end(),
                        std::back_inserter(left));
    rounded.insert(rounded.end(), fitted.at_folds.begin(), fitted.at_folds.end());
    sharp = std::move(left);
    fitted = sharp.empty() ? FittedSides{fit(mesh, constraints, points, options, context), {}}
                           : fit_sides(mesh, constraints, points, options, context);
  }
  FairReport& report = fitted.result.report.fair;
  if (rounded.empty()) return std::move(fitted.result);
  std::sort(rounded.begin(), rounded.end());
  report.warnings.emplace_back(
      WarningCode::sharp_edges_rounded,
      fmt::format("{} of {} sharp edges are not kept: the surface without its noise would fold there", rounded.size(),
                  all));
  report.rounded_edges = std::move(rounded);
  return std::move(fitted.result);
}

}  // namespace vspring
