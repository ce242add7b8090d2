#include "span/held_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "shape/direction.hpp"
#include "shape/sheets.hpp"

namespace vspring {

namespace {

// Curves that meet at a lesser angle tell no tangent plane: the sine of 15°.
constexpr double least_sine = 0.26;
// A node lies in a plane if it is no further from it than this share of the length of its curve.
constexpr double in_plane = 1e-6;

/// The tangent of a half-arc where it begins.
Vector3 tangent_at_start(const CurveNodes& nodes, Index half) {
  const std::vector<Index> along = nodes.along(half);
  std::vector<Vector3> places;
  for (std::size_t k = 0; k < std::min<std::size_t>(along.size(), 3); ++k)
    places.push_back(nodes.places[static_cast<std::size_t>(along[k])]);
  const Index first = 0;
  return estimate_tangents(PolygonCurve(std::move(places)), std::span(&first, 1)).front();
}

/// The nodes along which a surface ends, and what is known there.
struct EndNodes {
  std::vector<Index> nodes;  ///< of the surface; of a closed end, the first again at the end
  std::vector<Index> half;   ///< per node the half-arc that it is on
  std::vector<Vector3> places;
  std::vector<Vector3> tangents;
  std::vector<Vector3> known;  ///< normals; zero where not known
};

EndNodes nodes_of(const SurfaceEnd& end, const CurveNodes& nodes) {
  EndNodes result;
  std::vector<std::size_t> starts;
  for (const Index half : end.halves) {
    const std::vector<Index> along = nodes.along(half);
    const std::size_t skipped = result.nodes.empty() ? 0 : 1;
    starts.push_back(result.nodes.size() - skipped);
    result.nodes.insert(result.nodes.end(), along.begin() + static_cast<std::ptrdiff_t>(skipped), along.end());
    result.half.resize(result.nodes.size(), half);
  }
  starts.push_back(result.nodes.size() - 1);
  std::vector<Index> all;
  for (std::size_t k = 0; k < result.nodes.size(); ++k) {
    all.push_back(static_cast<Index>(k));
    result.places.push_back(nodes.places[static_cast<std::size_t>(result.nodes[k])]);
  }
  std::vector<Vector3> places = result.places;
  if (end.is_closed) {
    places.pop_back();
    all.pop_back();
  }
  result.tangents = estimate_tangents(PolygonCurve(std::move(places), end.is_closed), all);
  if (end.is_closed) result.tangents.push_back(result.tangents.front());
  result.known.assign(result.nodes.size(), Vector3::Zero());
  for (std::size_t k = 0; k < starts.size(); ++k) {
    double best = least_sine;
    for (const Index half : end.crossing[k]) {
      const Vector3 normal = result.tangents[starts[k]].cross(tangent_at_start(nodes, half));
      if (!(normal.norm() > best)) continue;
      best = normal.norm();
      result.known[starts[k]] = normal / best;
    }
  }
  return result;
}

/// At some nodes; zero at those that are −1.
std::vector<Vector3> normals_of_faces(const PolygonMesh& mesh, const std::vector<Index>& nodes) {
  std::vector<Index> known;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(known), [](Index node) { return node >= 0; });
  const std::vector<Vector3> normals = estimate_normals(mesh, known);
  std::vector<Vector3> result;
  result.reserve(nodes.size());
  auto next = normals.begin();
  for (const Index node : nodes) result.push_back(node >= 0 ? *next++ : Vector3::Zero());
  return result;
}

bool lies_in(const MirrorPlane& plane, const EndNodes& end) {
  const double size = (end.places.front() - end.places[end.places.size() / 2]).norm() +
                      (end.places.back() - end.places[end.places.size() / 2]).norm();
  return std::all_of(end.places.begin(), end.places.end(),
                     [&](const Vector3& place) { return std::abs(plane.distance(place)) <= in_plane * size; });
}

}  // namespace

HeldSurface hold_curves(const SpannedCurves& surface, const CurveNodes& nodes, const Arcs& arcs,
                        const std::vector<std::size_t>& numbers, const std::vector<Loop>& spanned,
                        const std::optional<MirrorPlane>& symmetry) {
  const auto on_curves = static_cast<Index>(nodes.places.size());
  std::vector<Index> all(nodes.places.size());
  std::iota(all.begin(), all.end(), 0);
  MeshOfSheets sheets = into_sheets(surface.mesh, all, surface.sharp_edges);
  HeldSurface held{std::move(sheets.mesh), std::move(sheets.origin)};
  const Index count = surface.mesh.node_count();
  held.constraints = Constraints(held.mesh.node_count());
  const auto original = [&](Index node) {
    return node < count ? node : held.origin[static_cast<std::size_t>(node - count)];
  };
  for (Index node = 0; node < held.mesh.node_count(); ++node) {
    if (original(node) < on_curves) held.constraints.fix_position(node, held.mesh.position(node));
  }
  // The nodes of each loop's own sheet, by half-arcs.
  std::vector<std::size_t> loop_of(2 * arcs.all().size(), numbers.size());
  std::vector<std::map<Index, Index>> own(numbers.size());
  for (std::size_t l = 0; l < numbers.size(); ++l) {
    for (const Index half : spanned[l].halves) loop_of[static_cast<std::size_t>(half)] = l;
    const NetworkLoop& loop = surface.loops[numbers[l]];
    for (Index f = loop.first_face; f < loop.first_face + loop.face_count; ++f) {
      for (const Index node : held.mesh.face(f)) {
        if (original(node) < on_curves) own[l].emplace(original(node), node);
      }
    }
  }
  std::vector<std::uint8_t> is_sharp;
  is_sharp.reserve(surface.curves.size());
  for (const NetworkCurve& curve : surface.curves) is_sharp.push_back(curve.is_sharp ? 1 : 0);
  std::vector<EndNodes> ends;
  std::vector<EndNodes> symmetric;
  for (const SurfaceEnd& end : find_ends(arcs, spanned, is_sharp)) {
    EndNodes here = nodes_of(end, nodes);
    const bool is_sharp_end = is_sharp[static_cast<std::size_t>(end.halves.front() / 2)] != 0;
    if (!symmetry || is_sharp_end || !lies_in(*symmetry, here)) {
      ends.push_back(std::move(here));
      continue;
    }
    for (std::size_t k = 0; k < here.known.size(); ++k)
      here.known[k] = direction(here.tangents[k].cross(symmetry->normal), 1);
    held.symmetric_nodes += static_cast<Index>(here.nodes.size()) - (end.is_closed ? 1 : 0);
    symmetric.push_back(std::move(here));
  }
  // Where both meet, the plane decides.
  for (const auto& group : {ends, symmetric}) {
    for (const EndNodes& here : group) {
      std::vector<Index> copies;  // −1: of no face
      copies.reserve(here.nodes.size());
      for (std::size_t k = 0; k < here.nodes.size(); ++k) {
        const auto& of_loop = own[loop_of[static_cast<std::size_t>(here.half[k])]];
        const auto copy = of_loop.find(here.nodes[k]);
        copies.push_back(copy != of_loop.end() ? copy->second : -1);
      }
      const std::vector<Vector3> normals =
          normals_along(here.places, here.tangents, here.known, normals_of_faces(held.mesh, copies));
      for (std::size_t k = 0; k < normals.size(); ++k) {
        if (copies[k] >= 0) held.constraints.fix_normal(copies[k], normals[k]);
      }
    }
  }
  return held;
}

}  // namespace vspring
