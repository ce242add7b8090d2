#include "shape/turned_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "shape/edges.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"

namespace vspring {

namespace {

// Difference of cosines.
constexpr double noticed_turn = 1e-9;

// Share of the area of a face below which it counts as none.
constexpr double no_area = 1e-6;

}  // namespace

TurnedEdges::TurnedEdges(const PolygonMesh& mesh, const MeshEdges& sharp) : mesh_(mesh) {
  const Incidence incidence(mesh);
  EdgeFinder edges(mesh, incidence);
  for (Index node = 0; node < mesh.node_count(); ++node) {
    edges.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour < node || uses.size() != 2) return;
      if (std::binary_search(sharp.begin(), sharp.end(), std::pair(node, neighbour))) return;
      pairs_.push_back({uses[0].face, uses[1].face, 0});
      pairs_.back().cosine = cosine(pairs_.back(), mesh.positions());
    });
  }
}

std::vector<Index> TurnedEdges::faces(const std::vector<Vector3>& positions) const {
  std::vector<Index> turned;
  for (const Pair& pair : pairs_) {
    if (is_turned(pair, positions)) turned.insert(turned.end(), {pair.first, pair.second});
  }
  return turned;
}

std::size_t TurnedEdges::count(const std::vector<Vector3>& positions) const {
  return static_cast<std::size_t>(std::count_if(
      pairs_.begin(), pairs_.end(), [&](const Pair& pair) { return cosine(pair, positions) < -noticed_turn; }));
}

void TurnedEdges::take_back(std::vector<Vector3>& positions) const {
  for (bool any = true; any;) {
    any = false;
    for (const Pair& pair : pairs_) {
      if (!is_turned(pair, positions)) continue;
      for (const Index face : {pair.first, pair.second}) {
        for (const Index node : mesh_.face(face)) {
          const auto i = static_cast<std::size_t>(node);
          any = any || positions[i] != mesh_.positions()[i];
          positions[i] = mesh_.positions()[i];
        }
      }
    }
  }
}

double TurnedEdges::cosine(const Pair& pair, const std::vector<Vector3>& at) const {
  return unit_normal(mesh_.face(pair.first), at).dot(unit_normal(mesh_.face(pair.second), at));
}

bool TurnedEdges::is_turned(const Pair& pair, const std::vector<Vector3>& at) const {
  return cosine(pair, at) < std::min(pair.cosine, 0.0) - noticed_turn;
}

bool loses_area(const PolygonMesh& mesh, const std::vector<Vector3>& positions) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double before = twice_vector_area(mesh.face(f), mesh.positions()).norm();
    if (before > 0 && !(twice_vector_area(mesh.face(f), positions).norm() > no_area * before)) return true;
  }
  return false;
}

}  // namespace vspring
