#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>

#include "shape/coincident_nodes.hpp"
#include "shape/edges.hpp"
#include "vspring/weld.hpp"

namespace vspring {

namespace {

/// The `nodes` that are in a group with another of them.
std::vector<Index> not_alone(const std::vector<Index>& nodes, const std::vector<Index>& first) {
  const auto first_of = [&](Index node) { return first[static_cast<std::size_t>(node)]; };
  std::vector<std::uint8_t> shared(first.size(), 0);
  for (const Index node : nodes) {
    if (first_of(node) != node) shared[static_cast<std::size_t>(first_of(node))] = 1;
  }
  std::vector<Index> found;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(found),
               [&](Index node) { return shared[static_cast<std::size_t>(first_of(node))] != 0; });
  return found;
}

}  // namespace

Seams find_seams(const PolygonMesh& mesh, double tolerance) {
  const FaceNodes used(mesh);
  const double length = used.length(tolerance);
  const Incidence incidence(mesh);
  EdgeFinder edges(mesh, incidence);
  std::vector<std::uint8_t> joined(static_cast<std::size_t>(mesh.face_count()), 0);
  std::vector<Index> boundary;
  for (const Index node : used.nodes) {
    bool open = false;
    edges.at_node(node, [&](Index /*neighbour*/, std::span<const EdgeUse> uses) {
      open = open || uses.size() == 1;
      if (uses.size() == 1) return;
      for (const EdgeUse& use : uses) joined[static_cast<std::size_t>(use.face)] = 1;
    });
    if (open) boundary.push_back(node);
  }
  Seams seams;
  for (Index f = 0; f < mesh.face_count(); ++f)
    seams.lone_faces += joined[static_cast<std::size_t>(f)] == 0 && mesh.face(f).size() >= 3 ? 1 : 0;
  seams.same = not_alone(boundary, coincident_nodes(mesh.positions(), boundary, used.box, 0).first);
  const CoincidentNodes near = coincident_nodes(mesh.positions(), boundary, used.box, length);
  seams.near_nodes = near.chained.first < 0 ? not_alone(boundary, near.first) : seams.same;
  return seams;
}

}  // namespace vspring
