#include "fit/lines_at_nodes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <variant>

#include "curve_fit/way.hpp"
#include "fit/kinds_of_fit.hpp"

namespace vspring {

namespace {

// Corners of loops turn by more than this, on stretches of at least so many edges, and of at least so many times the
// noise.
constexpr double least_turn_of_corner = std::numbers::pi / 3;
constexpr int least_edges_to_corner = 2;
constexpr double times_noise = 3;

// Shorter lines stay as they are when ends are placed.
constexpr std::size_t fewest_nodes_of_line = 5;
// Number of nodes from the end to the one that gives its direction; the most nodes that are used for it.
constexpr std::size_t nodes_of_direction = 3;
constexpr std::size_t most_nodes_that_tell = 10;
// As a share of the weight across.
constexpr double weight_along = 0.02;
// Share of a tolerance by which an end may move, so that it stays within it in spite of rounding.
constexpr double most_of_tolerance = 0.999;

/// Half the diagonal.
double reach_of_voxels(const Vector3& size) { return size.norm() / 2; }

/// How far from their true places nodes may be, by the noise to be taken off; 0 where that is not known.
double reach_of_noise(const FitOptions& options) {
  if (options.within()) return *options.within();
  if (options.voxels()) return reach_of_voxels(*options.voxels());
  return times_noise * options.noise().value_or(options.rms().value_or(0));
}

/// What lines go by where the surface goes by that.
FitCriterion criterion_of_lines(const FitOptions& options) {
  // A node of a mask may be as far from its true place as a voxel's corners are from its middle.
  if (options.voxels()) return Within{reach_of_voxels(*options.voxels())};
  // Across a curve in space noise has two directions.
  if (const auto noise = options.rms() ? options.rms() : options.noise())
    return RootMeanSquare{std::sqrt(2.0) * *noise};
  return options.criterion;
}

/// The share of a root mean square that so many directions across lines leave, where it allows for two.
double share_of_directions(const LinesOfSurface& lines, const std::vector<Index>& nodes) {
  double directions = 0;
  for (const Index node : nodes) directions += lines.directions_across(node);
  return std::sqrt(directions / (2 * std::max<double>(1, static_cast<double>(nodes.size()))));
}

FitResult fit_as_line(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                      const FitOptions& options, Context& context) {
  return options.noise() ? smooth_curve(curve, constraints, points, options, context)
                         : fit(curve, constraints, points, options, context);
}

/// An end of a line, its straight extension, and how reliable that is.
struct LineEnd {
  Vector3 place;
  Vector3 along;
  double weight;
};

/// The place with the least sum of squared distances from the lines through all ends.
Vector3 meeting_place(const std::vector<LineEnd>& ends) {
  if (ends.size() == 1) return ends.front().place;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Vector3 sum = Vector3::Zero();
  for (const LineEnd& end : ends) {
    const Eigen::Matrix3d across =
        end.weight * ((1 + weight_along) * Eigen::Matrix3d::Identity() - end.along * end.along.transpose());
    squares += across;
    sum += across * (end.place - ends.front().place);
  }
  return ends.front().place + squares.ldlt().solve(sum);
}

}  // namespace

FitOptions options_of_lines(FitOptions options) {
  options.fair.fair_boundary.reset();
  options.criterion = criterion_of_lines(options);
  return options;
}

void keep_corners(LinesOfSurface& lines, const FitOptions& options) {
  const double reach = reach_of_noise(options);
  if (!(reach > 0)) return;
  std::vector<int> passed(lines.curve.positions().size(), 0);
  for (const auto& line : lines.curve.chains()) {
    for (const Index node : line.nodes) ++passed[static_cast<std::size_t>(node)];
  }
  for (const auto& line : lines.curve.chains()) {
    std::vector<Vector3> way;
    for (const Index node : line.nodes) way.push_back(lines.curve.position(node));
    for (const std::size_t k :
         corners_of_way(way, line.closed, least_turn_of_corner, reach, {}, least_edges_to_corner)) {
      const Index node = line.nodes[k];
      // Where lines meet they are held, and have more sides than a corner.
      if (passed[static_cast<std::size_t>(node)] == 1 && !lines.of_curve.tangent_fixed(node))
        lines.of_curve.make_corner(node);
    }
  }
}

FitResult fit_lines(const PolygonMesh& mesh, LinesOfSurface& lines, const std::vector<double>& weights,
                    const LinesAlike& which, Context& context) {
  // The nodes of the lines alone: they are the points.
  std::vector<Index> node_of;
  std::vector<Index> number(mesh.positions().size(), -1);
  const auto& all = lines.curve.chains();
  std::vector<PolygonCurve::Chain> chains(all.begin() + static_cast<std::ptrdiff_t>(which.begin),
                                          all.begin() + static_cast<std::ptrdiff_t>(which.end));
  ScatteredPoints on_lines;
  for (auto& chain : chains) {
    for (Index& node : chain.nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (number[i] < 0) {
        number[i] = static_cast<Index>(node_of.size());
        node_of.push_back(node);
        on_lines.positions.push_back(lines.curve.position(node));
        if (!weights.empty()) on_lines.weights.push_back(weights[i]);
      }
      node = number[i];
    }
  }
  Constraints held(static_cast<Index>(node_of.size()));
  for (std::size_t k = 0; k < node_of.size(); ++k) held.hold_as(static_cast<Index>(k), lines.of_curve, node_of[k]);
  FitOptions options = which.options;
  const double share = share_of_directions(lines, node_of);
  if (options.rms() && share > 0 && share < 1) options.criterion = RootMeanSquare{share * *options.rms()};
  FitResult curve = fit_as_line(PolygonCurve(on_lines.positions, std::move(chains)), held, on_lines, options, context);
  std::vector<Vector3> positions = mesh.positions();
  for (std::size_t k = 0; k < node_of.size(); ++k) {
    positions[static_cast<std::size_t>(node_of[k])] = curve.positions[k];
    if (!lines.of_curve.position_fixed(node_of[k])) lines.hold(node_of[k], curve.positions[k]);
  }
  curve.positions = std::move(positions);
  return curve;
}

FitResult fit_lines(const PolygonMesh& mesh, LinesOfSurface& lines, const std::vector<double>& weights,
                    const FitOptions& options, Context& context) {
  return fit_lines(mesh, lines, weights, {0, lines.curve.chains().size(), options}, context);
}

void place_ends(const PolygonMesh& mesh, const Constraints& constraints, LinesOfSurface& lines,
                const std::vector<double>& weights, std::span<const LinesAlike> groups, Context& context) {
  if (groups.empty() || !std::holds_alternative<EquilibriumMethod>(groups.front().options.fair.method)) return;
  const auto is_free_end = [&](const PolygonCurve::Chain& chain, std::size_t k) {
    return (k == 0 || k + 1 == chain.nodes.size()) && !constraints.position_fixed(chain.nodes[k]);
  };
  std::map<Index, std::vector<LineEnd>> ends;
  for (const LinesAlike& which : groups) {
    std::vector<const PolygonCurve::Chain*> open;
    for (std::size_t c = which.begin; c < which.end; ++c) {
      if (!lines.curve.chains()[c].closed) open.push_back(&lines.curve.chains()[c]);
    }
    // Each line has nodes of its own.
    std::vector<Vector3> positions;
    std::vector<double> own_weights;
    std::vector<PolygonCurve::Chain> alone;
    Constraints held(0);
    for (const auto* const chain : open) {
      if (chain->nodes.size() < fewest_nodes_of_line) continue;
      alone.emplace_back();
      for (std::size_t k = 0; k < chain->nodes.size(); ++k) {
        const Index node = chain->nodes[k];
        const auto own = static_cast<Index>(positions.size());
        alone.back().nodes.push_back(own);
        positions.push_back(lines.curve.position(node));
        if (!weights.empty()) own_weights.push_back(weights[static_cast<std::size_t>(node)]);
        held.add_nodes(1);
        if (!is_free_end(*chain, k)) held.hold_as(own, lines.of_curve, node);
      }
    }
    if (!alone.empty()) {
      const PolygonCurve curve(positions, std::move(alone));
      const FitResult fitted =
          fit_as_line(curve, held, {.positions = positions, .weights = std::move(own_weights)}, which.options, context);
      if (fitted.report.fair.outcome == Outcome::cancelled) return;
      positions = fitted.positions;
    }
    std::size_t begin = 0;
    for (const auto* const chain : open) {
      const std::size_t count = chain->nodes.size();
      const bool is_short = count < fewest_nodes_of_line;
      const auto at = [&](std::size_t k) {
        return is_short ? lines.curve.position(chain->nodes[k]) : positions[begin + k];
      };
      const std::size_t inwards = std::min(nodes_of_direction, count - 1);
      for (const std::size_t k : {std::size_t{0}, count - 1}) {
        if (!is_free_end(*chain, k)) continue;
        const Vector3 way = at(k) - at(k == 0 ? inwards : count - 1 - inwards);
        ends[chain->nodes[k]].push_back(
            {at(k), way.stableNormalized(), static_cast<double>(std::min(count, most_nodes_that_tell))});
      }
      if (!is_short) begin += count;
    }
  }
  const auto within = groups.front().options.within();
  for (const auto& [node, all] : ends) {
    Vector3 place = meeting_place(all);
    if (within) {
      // The place where extended lines meet may be further from the former end than nodes may move.
      const Vector3 move = place - mesh.position(node);
      const double most = most_of_tolerance * *within;
      if (move.norm() > most) place = mesh.position(node) + most * move.normalized();
    }
    lines.fix(node, place);
  }
}

}  // namespace vspring
