#include "solve/lines_of_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace vspring {

LinesOfSurface::LinesOfSurface(const PolygonMesh& mesh, const Constraints& constraints, PolygonCurve lines)
    : curve(std::move(lines)),
      of_curve(mesh.node_count()),
      of_surface(constraints),
      places_(mesh.positions(), constraints) {
  std::vector<int> passed(mesh.positions().size(), 0);
  for (const auto& chain : curve.chains()) {
    for (const Index node : chain.nodes) ++passed[static_cast<std::size_t>(node)];
    if (chain.closed || chain.nodes.empty()) continue;
    for (const Index end : {chain.nodes.front(), chain.nodes.back()}) passed[static_cast<std::size_t>(end)] += 2;
  }
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const int times = passed[static_cast<std::size_t>(i)];
    if (times == 0) continue;
    if (times > 1 && !constraints.position_fixed(i)) {
      fix(i, mesh.position(i));
      continue;
    }
    if (constraints.position_fixed(i)) of_curve.fix_position(i, constraints.position(i));
    if (constraints.tangent_fixed(i)) of_curve.fix_tangent(i, constraints.tangent(i));
    if (!constraints.position_fixed(i)) free.push_back(i);
  }
  if (constraints.sliding_count() > 0) move_to(mesh.positions());
}

void LinesOfSurface::hold(const std::vector<Vector3>& positions) {
  for (const Index i : free) hold(i, positions[static_cast<std::size_t>(i)]);
}

void LinesOfSurface::hold(Index node, const Vector3& place) { of_surface.fix_position(node, places_(node, place)); }

void LinesOfSurface::fix(Index node, const Vector3& place) {
  of_curve.fix_position(node, places_(node, place));
  of_surface.fix_position(node, of_curve.position(node));
}

int LinesOfSurface::directions_across(Index node) const {
  const Support* const support = places_.support(node);
  if (support == nullptr) return 2;
  return support->is_curve() ? 0 : 1;
}

void LinesOfSurface::move_to(const std::vector<Vector3>& positions) {
  std::vector<Vector3> moved = positions;
  for (const Index i : free) moved[static_cast<std::size_t>(i)] = places_(i, moved[static_cast<std::size_t>(i)]);
  curve.set_positions(std::move(moved));
}

void account_for_moves(const PolygonMesh& mesh, const Constraints& constraints, double strength,
                       std::vector<Vector3>& positions, FairReport& report) {
  std::vector<double> moves;
  const PlacesOnSupports places(mesh.positions(), constraints);
  report.fixed_positions = 0;
  report.sliding_nodes = constraints.sliding_count();
  for (Index i = 0; i < mesh.node_count(); ++i) {
    Vector3& position = positions[static_cast<std::size_t>(i)];
    if (constraints.position_fixed(i)) ++report.fixed_positions;
    if (constraints.position_fixed(i) || position == mesh.position(i)) continue;
    const Vector3 move = strength * (position - mesh.position(i));
    if (strength < 1) position = places(i, mesh.position(i) + move);
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

void join(const FairReport& lines, FairReport& report) {
  if (report.outcome == Outcome::converged) report.outcome = lines.outcome;
  report.warnings.insert(report.warnings.begin(), lines.warnings.begin(), lines.warnings.end());
}

}  // namespace vspring
