#include "fit/finished_nodes.hpp"

#include <algorithm>
#include <utility>

#include "constraints/sides.hpp"

namespace vspring {

namespace {

// As a share of the edge before or after.
constexpr double sparse_share = 0.05;
// In allowed distances from the polyline.
constexpr double next_to_nothing_beyond = 1.001;

/// Whether no edge is much shorter than those about it, and none shorter than the tolerance.
bool are_sparse(const PolygonCurve& curve, double tolerance) {
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    double before = 0;
    for (std::size_t k = 0; k + 1 < count + (chain.closed ? 1 : 0); ++k) {
      const double edge = (curve.position(chain.nodes[(k + 1) % count]) - curve.position(chain.nodes[k])).norm();
      if (edge < tolerance || edge < sparse_share * before || before < sparse_share * edge * (k > 0 ? 1 : 0))
        return false;
      before = edge;
    }
  }
  return true;
}

bool is_fairer(const CurveFigures& a, const CurveFigures& b) {
  return a.curvature_variation < b.curvature_variation && a.curvature_extrema <= b.curvature_extrema &&
         a.inflections <= b.inflections;
}

}  // namespace

void FinishedNodes::finish(MeasuredNodes& nodes) {
  draw_chords_in(nodes);
  pull_to_rows(nodes);
  keep_what_is_fairer(nodes);
}

/// The chords between nodes that are far apart cut corners of the curve off. Where they leave the tolerance, nodes move
/// until their chords are within it; in a coarse table elsewhere, too, if the chords become fairer.
void FinishedNodes::draw_chords_in(MeasuredNodes& before) {
  const auto tolerance = input_.options().tolerance();
  const bool are_new = !before.nodes.from.empty();
  // At a station of its own no node is cut off.
  if (!tolerance || context_.cancelled() || (!are_new && input_.moving() != Vector3::Ones())) return;
  if (before.figure <= *tolerance && !(input_.options().within() && are_sparse(before.nodes.curve, *tolerance))) return;
  const DenseCurve chords = measures_.chords(before.nodes.curve, before.nodes);
  CurveFitTask task = input_.task();
  task.nodes = &chords;
  task.evenly = true;
  task.scattered = found_.points;
  task.way = found_.way;
  carry_places(found_.curve, chords, task.scattered);
  carry_places(found_.curve, chords, task.way);
  const CurveFound drawn = vspring::fit_curve(task, [](double) {});
  Resampled moved = before.nodes;
  std::vector<Vector3> places = moved.curve.positions();
  for (std::uint32_t i = 0; i < drawn.curve.size(); ++i) {
    const auto& node = drawn.curve.node(i);
    if (!node.held) places[static_cast<std::size_t>(node.from)] = input_.to_input(node.place);
  }
  moved.curve.set_positions(std::move(places));
  MeasuredNodes after = measures_.measured(std::move(moved));
  // Points may lie on a curve that goes far astray between them.
  const bool stays = after.way_off <= far_off_way * std::max(before.way_off, *tolerance) &&
                     after.radius_kept >= before.radius_kept && after.new_folds <= before.new_folds;
  const bool better = before.figure > *tolerance
                          ? after.figure < before.figure
                          : is_fairer(after.figures, before.figures) && after.figure <= *tolerance &&
                                drawn.beyond <= next_to_nothing_beyond;
  if (better && stays) before = std::move(after);
}

/// Where the curve is not within the tolerance of some rows, their nodes move to within it of the rows, and so do the
/// chords.
void FinishedNodes::pull_to_rows(MeasuredNodes& found) {
  const auto within = input_.options().within();
  if (!within || !input_.own_nodes() || !found.nodes.from.empty()) return;
  // Rows about a held node would only make the curve follow their noise.
  const auto points_off = [&](const Resampled& nodes) {
    return measures_.figure(measures_.movable_distances(nodes, about_held));
  };
  if (points_off(found.nodes) <= *within) return;
  std::vector<Vector3> places = found.nodes.curve.positions();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (input_.kept()[i] == 0 || input_.constraints().position_fixed(static_cast<Index>(i))) continue;
    const Vector3 row = input_.curve().position(static_cast<Index>(i));
    if ((places[i] - row).norm() > *within)
      places[i] = row + share_of_nearer * *within * (places[i] - row).normalized();
  }
  Resampled pulled = found.nodes;
  pulled.curve.set_positions(std::move(places));
  MeasuredNodes now = measures_.measured(std::move(pulled));
  // Between rows in their own order, also where the way has another.
  now.figure = points_off(now.nodes);
  if (!(now.figure < found.figure) || now.new_folds > found.new_folds) return;
  if (now.figure <= *within) now.way_beyond = 0;
  found = std::move(now);
  found_.converged = false;
}

/// Takes the rows themselves, which are within any tolerance, where the curve that was found is no fairer.
void FinishedNodes::keep_what_is_fairer(MeasuredNodes& found) const {
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
  // They are the polyline, in their own order.
  rows.way_beyond = 0;
  // A shape that may not be the fairest must not vary more than the input.
  const bool varies_less = rows.figures.curvature_variation < found.figures.curvature_variation;
  if (rows.radius_kept == 1 && (found_.converged ? is_fairer(rows.figures, found.figures) : varies_less))
    found = std::move(rows);
}

}  // namespace vspring
