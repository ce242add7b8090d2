#include "solve/chains_at_folds.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "shape/sharp_edges.hpp"

namespace vspring {

namespace {

// Degrees, of an edge.
constexpr double turned_over = 90;
// Degrees by which a sharp edge turns more than its chain does on average in the mesh: noise takes 25° off the mean of
// true creases, and adds as much to an edge.
constexpr double much_more = 50;
// Of the nodes of a chain. A true crease in strong noise may have a fold or two.
constexpr double share_at_folds = 0.125;

/// How much a sharp edge turns, in degrees.
struct Turns {
  double before = 0;   ///< in the mesh
  double if_over = 0;  ///< where it has turned over; else 0
};

MeshEdges edges_of(const PolygonCurve::Chain& chain) {
  MeshEdges edges;
  for (std::size_t k = 1; k < chain.nodes.size(); ++k)
    edges.emplace_back(std::minmax(chain.nodes[k - 1], chain.nodes[k]));
  if (chain.closed) edges.emplace_back(std::minmax(chain.nodes.back(), chain.nodes.front()));
  return edges;
}

}  // namespace

MeshEdges chains_at_folds(const PolygonMesh& mesh, const std::vector<Vector3>& positions,
                          const MeshEdges& sharp_edges) {
  const SharpEdges sharp = as_sharp_edges(mesh, sharp_edges);
  PolygonMesh surface = mesh;
  surface.set_positions(positions);
  const auto has_moved = [&](Index face) {
    const auto nodes = mesh.face(face);
    return std::any_of(nodes.begin(), nodes.end(), [&](Index i) { return mesh.position(i) != surface.position(i); });
  };
  std::vector<std::uint8_t> at_fold(positions.size(), 0);
  std::vector<Turns> turns(sharp.edges.size());
  // Null for edges that are not sharp.
  const auto turns_of = [&](const std::pair<Index, Index>& edge) -> Turns* {
    const auto found = std::lower_bound(sharp.edges.begin(), sharp.edges.end(), edge);
    if (found == sharp.edges.end() || *found != edge) return nullptr;
    return &turns[static_cast<std::size_t>(found - sharp.edges.begin())];
  };
  for (const TurningEdge& edge : turning_edges(surface)) {
    if (edge.turn <= turned_over || !(has_moved(edge.face) || has_moved(edge.other_face))) continue;
    if (Turns* const sharp_edge = turns_of({edge.first, edge.second})) {
      sharp_edge->if_over = edge.turn;
      continue;
    }
    for (const Index face : {edge.face, edge.other_face}) {
      for (const Index node : surface.face(face)) at_fold[static_cast<std::size_t>(node)] = 1;
    }
  }
  for (const TurningEdge& edge : turning_edges(mesh)) {
    if (Turns* const sharp_edge = turns_of({edge.first, edge.second})) sharp_edge->before = edge.turn;
  }
  MeshEdges at_folds;
  for (const PolygonCurve::Chain& chain : sharp.chains.chains()) {
    const MeshEdges edges = edges_of(chain);
    double most = 0;
    for (const auto& edge : edges) most += turns_of(edge)->before / static_cast<double>(edges.size());
    most += much_more;
    std::vector<std::uint8_t> folds;
    for (const Index node : chain.nodes) folds.push_back(at_fold[static_cast<std::size_t>(node)]);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (turns_of(edges[k])->if_over > most) folds[k] = folds[(k + 1) % folds.size()] = 1;
    }
    const auto count = static_cast<double>(std::count(folds.begin(), folds.end(), 1));
    if (count > share_at_folds * static_cast<double>(folds.size()))
      at_folds.insert(at_folds.end(), edges.begin(), edges.end());
  }
  std::sort(at_folds.begin(), at_folds.end());
  return at_folds;
}

}  // namespace vspring
