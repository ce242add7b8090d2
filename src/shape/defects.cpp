#include <fmt/format.h>

#include <algorithm>

#include "shape/edges.hpp"
#include "shape/face_geometry.hpp"
#include "shape/fan.hpp"
#include "shape/frame.hpp"
#include "shape/places.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

/// Faces with the same nodes in any order; the later one names the earlier.
void find_duplicates(const PolygonMesh& mesh, std::vector<Defect>& defects) {
  std::vector<std::vector<Index>> sorted(static_cast<std::size_t>(mesh.face_count()));
  std::vector<Index> order(sorted.size());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    auto& nodes = sorted[static_cast<std::size_t>(f)];
    nodes.assign(face.begin(), face.end());
    std::sort(nodes.begin(), nodes.end());
    order[static_cast<std::size_t>(f)] = f;
  }
  const auto nodes_of = [&](Index f) -> const std::vector<Index>& { return sorted[static_cast<std::size_t>(f)]; };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return nodes_of(a) != nodes_of(b) ? nodes_of(a) < nodes_of(b) : a < b; });
  for (std::size_t first = 0, k = 1; k < order.size(); ++k) {
    if (nodes_of(order[k]) != nodes_of(order[first])) {
      first = k;
    } else if (!nodes_of(order[k]).empty()) {
      defects.push_back({.kind = Defect::Kind::duplicate_face, .other = order[first], .face = order[k]});
    }
  }
}

/// Computed in the face's own coordinates, so squares neither overflow nor vanish, whatever its size and place.
bool has_area(const PolygonMesh& mesh, std::span<const Index> face) {
  if (!unit_normal(face, mesh.positions()).isZero(0)) return true;
  Eigen::AlignedBox<double, 3> box;
  for (const Index node : face) box.extend(mesh.position(node));
  const Frame frame(box);
  std::vector<Vector3> positions;
  std::vector<Index> places;
  for (const Index node : face) {
    places.push_back(static_cast<Index>(places.size()));
    positions.push_back(frame.to_local(mesh.position(node)));
  }
  return !unit_normal(places, positions).isZero(0);
}

/// Of a face of three or more nodes.
bool is_without_area(const PolygonMesh& mesh, std::span<const Index> face) {
  return std::all_of(face.begin(), face.end(), [&](Index i) { return mesh.position(i).allFinite(); }) &&
         !has_area(mesh, face);
}

void find_face_defects(const PolygonMesh& mesh, std::vector<Defect>& defects) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() < 3) {
      defects.push_back({.kind = Defect::Kind::too_few_nodes, .face = f});
      continue;
    }
    std::vector<Index> nodes(face.begin(), face.end());
    std::sort(nodes.begin(), nodes.end());
    const auto repeated = std::adjacent_find(nodes.begin(), nodes.end());
    if (repeated != nodes.end()) {
      defects.push_back({.kind = Defect::Kind::repeated_node, .node = *repeated, .face = f});
    } else if (is_without_area(mesh, face)) {
      defects.push_back({.kind = Defect::Kind::zero_area_face, .face = f});
    }
  }
}

void find_node_defects(const PolygonMesh& mesh, std::vector<Defect>& defects) {
  const Incidence incidence(mesh);
  FanWalker walker(mesh, incidence);
  EdgeFinder edges(mesh, incidence);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!mesh.position(i).allFinite()) defects.push_back({.kind = Defect::Kind::not_finite, .node = i});
    const Fan& fan = walker.walk(i);
    if (fan.chains == 0) defects.push_back({.kind = Defect::Kind::isolated_node, .node = i});
    bool crowded = false;
    edges.at_node(i, [&](Index j, std::span<const EdgeUse> uses) {
      crowded = crowded || uses.size() > 2;
      if (j <= i) return;
      if (uses.size() > 2) defects.push_back({.kind = Defect::Kind::non_manifold_edge, .node = i, .other = j});
      if (uses.size() == 2 && uses[0].forward == uses[1].forward)
        defects.push_back({.kind = Defect::Kind::orientation, .node = i, .other = j});
      if (mesh.position(i) == mesh.position(j))
        defects.push_back({.kind = Defect::Kind::zero_length_edge, .node = i, .other = j});
    });
    // At the ends of an edge with too many faces, fans are several for that reason alone.
    if (fan.chains > 1 && !crowded) defects.push_back({.kind = Defect::Kind::non_manifold_node, .node = i});
  }
}

}  // namespace

std::string Defect::message() const {
  switch (kind) {
    case Kind::not_finite:
      return fmt::format("node {}: a coordinate is not finite", node);
    case Kind::isolated_node:
      return fmt::format("node {}: no face uses it", node);
    case Kind::too_few_nodes:
      return fmt::format("face {}: it has fewer than three nodes", face);
    case Kind::repeated_node:
      return fmt::format("face {}: node {} occurs in it more than once", face, node);
    case Kind::duplicate_face:
      return fmt::format("face {}: it has the same nodes as face {}", face, other);
    case Kind::non_manifold_edge:
      return fmt::format("edge {}–{}: more than two faces share it", node, other);
    case Kind::non_manifold_node:
      return fmt::format("node {}: its faces form more than one fan", node);
    case Kind::orientation:
      return fmt::format("edge {}–{}: its two faces run along it in the same direction", node, other);
    case Kind::zero_length_edge:
      return fmt::format("edge {}–{}: both ends are at the same position", node, other);
    case Kind::zero_area_face:
      return fmt::format("face {}: it has no area", face);
  }
  return {};
}

std::vector<Defect> check(const PolygonMesh& mesh) {
  std::vector<Defect> defects;
  find_face_defects(mesh, defects);
  find_duplicates(mesh, defects);
  find_node_defects(mesh, defects);
  std::stable_sort(defects.begin(), defects.end(), [](const Defect& a, const Defect& b) { return a.kind < b.kind; });
  return defects;
}

void require_places(std::span<const Index> nodes, const std::vector<Vector3>& positions) {
  for (const Index node : nodes) {
    if (!positions[static_cast<std::size_t>(node)].allFinite())
      throw Error(ErrorCode::unusable_shape, Defect{.kind = Defect::Kind::not_finite, .node = node}.message(),
                  {{Remedy::input, "correct it"}});
  }
}

std::vector<Index> faces_without_area(const PolygonMesh& mesh) {
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).size() >= 3 && is_without_area(mesh, mesh.face(f))) faces.push_back(f);
  }
  return faces;
}

}  // namespace vspring
