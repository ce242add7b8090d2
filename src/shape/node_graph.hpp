#pragma once

#include <span>
#include <vector>

#include "shape/incidence.hpp"

namespace vspring {

/// Nodes joined by edges, read off the faces.
class NodeGraph {
 public:
  NodeGraph(const PolygonMesh& mesh, const Incidence& incidence) : mesh_(&mesh), incidence_(&incidence) {}

  [[nodiscard]] Index size() const noexcept { return mesh_->node_count(); }

  /// Calls use(j) for every edge from `node` to j, in a fixed order; most edges come twice, once from each of their
  /// faces.
  template <typename Use>
  void for_each_neighbour(Index node, const Use& use) const {
    for (const Corner corner : incidence_->corners(node)) {
      const auto face = mesh_->face(corner.face);
      const auto size = static_cast<Index>(face.size());
      use(face[static_cast<std::size_t>(corner.place + 1 < size ? corner.place + 1 : 0)]);
      use(face[static_cast<std::size_t>(corner.place > 0 ? corner.place - 1 : size - 1)]);
    }
  }

 private:
  const PolygonMesh* mesh_;
  const Incidence* incidence_;
};

/// Orders `nodes` so that neighbours come close together: breadth first from a node at the rim of each component
/// (Cuthill and McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969). Depends on connectivity alone, so
/// that moved, turned and scaled copies of a mesh are ordered alike. Cost: linear.
std::vector<Index> order_for_locality(const NodeGraph& graph, std::span<const Index> nodes);

}  // namespace vspring
