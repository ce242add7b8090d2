#include "constraints/active_submesh.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace vspring {

namespace {

/// Marks all nodes of the faces that have a marked node. Returns the numbers of these faces and of their corners.
std::pair<std::size_t, std::size_t> widen(const PolygonMesh& mesh, std::vector<std::uint8_t>& marked,
                                          std::vector<std::uint8_t>& faces) {
  const std::vector<std::uint8_t> before = marked;
  std::size_t count = 0;
  std::size_t corners = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::none_of(face.begin(), face.end(), [&](Index i) { return before[static_cast<std::size_t>(i)] != 0; }))
      continue;
    for (const Index i : face) marked[static_cast<std::size_t>(i)] = 1;
    faces[static_cast<std::size_t>(f)] = 1;
    ++count;
    corners += face.size();
  }
  return {count, corners};
}

}  // namespace

std::optional<ActiveSubmesh> active_submesh(const PolygonMesh& mesh, const Constraints& constraints) {
  if (constraints.node_count() != mesh.node_count()) return {};
  std::vector<std::uint8_t> marked(static_cast<std::size_t>(mesh.node_count()));
  Index moving = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const bool moves = !constraints.position_fixed(i);
    marked[static_cast<std::size_t>(i)] = moves ? 1 : 0;
    moving += moves ? 1 : 0;
  }
  if (moving > mesh.node_count() / 2) return {};

  std::vector<std::uint8_t> faces(static_cast<std::size_t>(mesh.face_count()), 0);
  (void)widen(mesh, marked, faces);
  const auto [face_count, corner_count] = widen(mesh, marked, faces);

  std::vector<Index> node;
  std::vector<Index> local(marked.size());
  std::vector<Vector3> positions;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (marked[static_cast<std::size_t>(i)] == 0) continue;
    local[static_cast<std::size_t>(i)] = static_cast<Index>(node.size());
    node.push_back(i);
    positions.push_back(mesh.position(i));
  }
  std::vector<Index> face_begin;
  face_begin.reserve(face_count + 1);
  std::vector<Index> corners;
  corners.reserve(corner_count);
  face_begin.push_back(0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (faces[static_cast<std::size_t>(f)] == 0) continue;
    for (const Index i : mesh.face(f)) corners.push_back(local[static_cast<std::size_t>(i)]);
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  Constraints held = constraints_of(constraints, node);
  return ActiveSubmesh{.mesh = PolygonMesh(std::move(positions), std::move(face_begin), std::move(corners)),
                       .constraints = std::move(held),
                       .node = std::move(node)};
}

Constraints constraints_of(const Constraints& constraints, const std::vector<Index>& nodes) {
  Constraints part(static_cast<Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k) part.hold_as(static_cast<Index>(k), constraints, nodes[k]);
  return part;
}

}  // namespace vspring
