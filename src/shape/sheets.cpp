#include "shape/sheets.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "shape/edges.hpp"
#include "shape/incidence.hpp"

namespace vspring {

MeshOfSheets into_sheets(const PolygonMesh& mesh, std::span<const Index> nodes,
                         std::span<const std::pair<Index, Index>> sharp) {
  const Incidence incidence(mesh);
  EdgeFinder edges(mesh, incidence);
  std::vector<Index> corners = mesh.corners();
  std::vector<Vector3> positions = mesh.positions();
  std::vector<Index> origin;
  for (const Index node : nodes) {
    const auto around = incidence.corners(node);
    const auto place_of = [&](Index face) {
      const auto found = std::lower_bound(around.begin(), around.end(), face,
                                          [](const Corner& corner, Index f) { return corner.face < f; });
      return static_cast<std::size_t>(found - around.begin());
    };
    const bool is_twice_in_one = std::adjacent_find(around.begin(), around.end(), [](const Corner& a, const Corner& b) {
                                   return a.face == b.face;
                                 }) != around.end();
    if (around.empty() || is_twice_in_one) continue;
    DisjointSets sheets(around.size());
    edges.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      const std::pair<Index, Index> edge = std::minmax(node, neighbour);
      if (uses.size() == 2 && !std::binary_search(sharp.begin(), sharp.end(), edge))
        (void)sheets.join(place_of(uses[0].face), place_of(uses[1].face));
    });
    std::vector<Index> node_of(around.size(), -1);
    node_of[sheets.find(0)] = node;
    for (std::size_t k = 0; k < around.size(); ++k) {
      Index& own = node_of[sheets.find(k)];
      if (own < 0) {
        own = static_cast<Index>(positions.size());
        positions.push_back(mesh.position(node));
        origin.push_back(node);
      }
      const Index corner = mesh.face_begin(around[k].face) + around[k].place;
      corners[static_cast<std::size_t>(corner)] = own;
    }
  }
  return {PolygonMesh(std::move(positions), mesh.face_begin(), std::move(corners)), std::move(origin)};
}

}  // namespace vspring
