#include "fit/fit_subject.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "checks/new_crossings.hpp"
#include "constraints/holding.hpp"
#include "fairness/measure.hpp"
#include "solve/part_of_mesh.hpp"

namespace vspring {

namespace {

/// The faces none of whose nodes moves, with nodes at their held places; those of fewer than three nodes are left out.
PolygonMesh rest_of(const PolygonMesh& mesh, const Constraints& constraints) {
  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    const auto is_held = [&](Index i) { return constraints.position_fixed(i); };
    if (face.size() < 3 || !std::all_of(face.begin(), face.end(), is_held)) continue;
    corners.insert(corners.end(), face.begin(), face.end());
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  return {positions_as_held(mesh.positions(), constraints), std::move(face_begin), std::move(corners)};
}

/// The edges of other faces neither of whose nodes moves, at their held places, and held nodes without such an edge.
PolygonCurve held_edges(const PolygonMesh& mesh, const Constraints& constraints) {
  std::vector<PolygonCurve::Chain> edges;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    const auto is_held = [&](Index i) { return constraints.position_fixed(i); };
    if (std::all_of(face.begin(), face.end(), is_held)) continue;
    for (std::size_t k = 0; k < face.size(); ++k) {
      if (!is_held(face[k])) continue;
      const Index next = face[(k + 1) % face.size()];
      const Index before = face[(k + face.size() - 1) % face.size()];
      if (is_held(next))
        edges.push_back({{face[k], next}, false});
      else if (!is_held(before))
        edges.push_back({{face[k], face[k]}, false});
    }
  }
  return {positions_as_held(mesh.positions(), constraints), std::move(edges)};
}

/// Held nodes and the edges between them, at their held places.
PolygonCurve held_edges(const PolygonCurve& curve, const Constraints& constraints) {
  const auto is_held = [&](Index i) { return constraints.position_fixed(i); };
  std::vector<PolygonCurve::Chain> edges;
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Index here = chain.nodes[k];
      const Index next = chain.nodes[k + 1 < count || chain.closed ? (k + 1) % count : k];
      if (is_held(here)) edges.push_back({{here, is_held(next) ? next : here}, false});
    }
  }
  return {positions_as_held(curve.positions(), constraints), std::move(edges)};
}

void keep_less(std::vector<double>& values, const std::vector<double>& others) {
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = std::min(values[j], others[j]);
}

bool held_in_place(const PolygonMesh& mesh, const Constraints& constraints) {
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (constraints.position_fixed(i) && constraints.position(i) != mesh.position(i)) return false;
  }
  return true;
}

}  // namespace

FitSurface::FitSurface(const PolygonMesh& mesh, const Constraints& constraints, std::span<const Vector3> points,
                       const Context& measuring, ThreadTeam& team)
    : whole_(&mesh),
      constraints_(&constraints),
      points_(points),
      measuring_(&measuring),
      team_(&team),
      part_(active_submesh(mesh, constraints)) {
  if (part_ && part_->mesh.face_count() == 0) part_.reset();
}

std::vector<Warning> FitSurface::check(std::span<const std::uint8_t> pulled) const {
  return check_part(*whole_, part_, *constraints_, pulled);
}

Net FitSurface::gather(bool for_spheres) const { return gather_part(*whole_, part_, *constraints_, for_spheres); }

Fairness FitSurface::fairness(const std::vector<Vector3>& positions) {
  const Constraints* held = part_ ? &part_->constraints : constraints_;
  if (!meter_) meter_.emplace(part_ ? part_->mesh : *whole_, held, *team_);
  return part_ ? meter_->measure(values_of(positions, part_->node), held) : meter_->measure(positions, held);
}

std::vector<double> FitSurface::distances(const std::vector<Vector3>& positions) {
  PolygonMesh mesh = part_ ? part_->mesh : *whole_;
  mesh.set_positions(part_ ? values_of(positions, part_->node) : positions);
  std::vector<double> distances = point_distances(points_, mesh, *measuring_);
  if (part_) keep_less(distances, distances_from_rest());
  return distances;
}

const std::vector<double>& FitSurface::distances_from_rest() {
  if (from_rest_.empty()) {
    const PolygonMesh rest = rest_of(*whole_, *constraints_);
    if (rest.face_count() == 0)
      from_rest_.assign(points_.size(), std::numeric_limits<double>::infinity());
    else
      from_rest_ = point_distances(points_, rest, *measuring_);
  }
  return from_rest_;
}

std::vector<double> FitSurface::distances_from_held() {
  const std::vector<Vector3>& nodes = whole_->positions();
  if (std::equal(points_.begin(), points_.end(), nodes.begin(), nodes.end())) {
    std::vector<double> from_held(nodes.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto node = static_cast<Index>(i);
      if (constraints_->position_fixed(node) && constraints_->position(node) == nodes[i]) from_held[i] = 0;
    }
    return from_held;
  }
  std::vector<double> from_held = distances_from_rest();
  const PolygonCurve edges = held_edges(*whole_, *constraints_);
  if (!edges.chains().empty()) keep_less(from_held, point_distances(points_, edges, *measuring_));
  return from_held;
}

const std::vector<double>& FitSurface::distances_before() {
  if (!before_.empty()) return before_;
  before_ = part_ && held_in_place(*whole_, *constraints_) ? distances(whole_->positions())
                                                           : point_distances(points_, *whole_, *measuring_);
  return before_;
}

std::vector<std::uint8_t> FitSurface::usable() const {
  std::vector<std::uint8_t> usable(static_cast<std::size_t>(whole_->node_count()), 0);
  for (Index f = 0; f < whole_->face_count(); ++f) {
    const auto face = whole_->face(f);
    if (face.size() < 3) continue;
    for (const Index node : face) usable[static_cast<std::size_t>(node)] = 1;
  }
  return usable;
}

std::string FitSurface::crossings(const std::vector<Vector3>& positions, const Context& context) const {
  return new_crossings(*whole_, positions, context, *team_);
}

SurfaceSides FitSurface::sides() const {
  SurfaceSides sides{.normals = std::vector<Vector3>(static_cast<std::size_t>(whole_->node_count()), Vector3::Zero())};
  double edges = 0;
  for (Index f = 0; f < whole_->face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = whole_->face(f);
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector3 here = whole_->position(face[k]) - whole_->position(face[0]);
      const Vector3 next = whole_->position(face[(k + 1) % face.size()]) - whole_->position(face[0]);
      if (!here.allFinite() || !next.allFinite()) continue;
      area += here.cross(next);
      sides.mean_edge += (next - here).norm();
      edges += 1;
    }
    for (const Index node : face) sides.normals[static_cast<std::size_t>(node)] += area;
  }
  for (Vector3& normal : sides.normals) normal.stableNormalize();
  sides.mean_edge /= std::max(edges, 1.0);
  return sides;
}

FitCurve::FitCurve(const PolygonCurve& curve, const Constraints& constraints, std::span<const Vector3> points,
                   const Context& measuring, ThreadTeam& /*team*/)
    : curve_(&curve), constraints_(&constraints), points_(points), measuring_(&measuring) {}

std::vector<Warning> FitCurve::check(std::span<const std::uint8_t> pulled) const {
  return check_constraints(*curve_, *constraints_, pulled);
}

Net FitCurve::gather() const { return gather_net(*curve_, *constraints_); }

PolygonCurve FitCurve::with(const std::vector<Vector3>& positions) const {
  PolygonCurve curve = *curve_;
  curve.set_positions(positions);
  return curve;
}

Fairness FitCurve::fairness(const std::vector<Vector3>& positions) const {
  return measure(with(positions), constraints_);
}

std::vector<double> FitCurve::distances(const std::vector<Vector3>& positions) const {
  return point_distances(points_, with(positions), *measuring_);
}

std::vector<double> FitCurve::distances_before() const { return point_distances(points_, *curve_, *measuring_); }

std::vector<double> FitCurve::distances_from_held() const {
  const std::vector<Vector3>& nodes = curve_->positions();
  if (std::equal(points_.begin(), points_.end(), nodes.begin(), nodes.end())) return {};
  const PolygonCurve held = held_edges(*curve_, *constraints_);
  return held.chains().empty() ? std::vector<double>() : point_distances(points_, held, *measuring_);
}

std::vector<std::uint8_t> FitCurve::usable() const {
  std::vector<std::uint8_t> usable(static_cast<std::size_t>(curve_->node_count()), 0);
  for (const auto& chain : curve_->chains()) {
    for (const Index node : chain.nodes) usable[static_cast<std::size_t>(node)] = 1;
  }
  return usable;
}

}  // namespace vspring
