#include "rules/edges_between.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shape/edges.hpp"
#include "shape/incidence.hpp"

namespace vspring {

MeshEdges edges_between(const PolygonMesh& mesh, const std::vector<Index>& nodes, Index named_nodes) {
  std::vector<std::uint8_t> is_one(mesh.positions().size(), 0);
  for (const Index node : nodes) is_one[static_cast<std::size_t>(node)] = 1;
  const auto all_are = [&](Index face) {
    const auto of = mesh.face(face);
    return std::all_of(of.begin(), of.end(), [&](Index node) { return is_one[static_cast<std::size_t>(node)] != 0; });
  };
  const auto is_image = [&](Index face) {
    const auto of = mesh.face(face);
    return std::any_of(of.begin(), of.end(), [&](Index node) { return node >= named_nodes; });
  };
  const Incidence incidence(mesh);
  EdgeFinder finder(mesh, incidence);
  MeshEdges edges;
  for (Index node = 0; node < mesh.node_count(); ++node) {
    if (is_one[static_cast<std::size_t>(node)] == 0) continue;
    finder.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour <= node || is_one[static_cast<std::size_t>(neighbour)] == 0 || uses.size() != 2) return;
      const Index a = uses[0].face;
      const Index b = uses[1].face;
      const bool is_inside = (is_image(a) || all_are(a)) && (is_image(b) || all_are(b));
      if (!is_inside) edges.emplace_back(node, neighbour);
    });
  }
  return edges;
}

}  // namespace vspring
