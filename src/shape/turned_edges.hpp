#pragma once

#include <cstddef>
#include <vector>

#include "vspring/polygon_mesh.hpp"
#include "vspring/sharp_edges.hpp"

namespace vspring {

/// The edges between two faces of a mesh, and which way these look in it.
class TurnedEdges {
 public:
  /// sharp: edges that may turn, and do not count; ascending, the smaller node first. The mesh must outlive it. Cost: n
  /// log n.
  explicit TurnedEdges(const PolygonMesh& mesh, const MeshEdges& sharp = {});

  /// The faces at edges that turn by more than a right angle, with nodes at `positions`, and further than in the mesh.
  [[nodiscard]] std::vector<Index> faces(const std::vector<Vector3>& positions) const;
  /// How many edges turn by more than a right angle, with nodes at `positions`.
  [[nodiscard]] std::size_t count(const std::vector<Vector3>& positions) const;
  /// Nodes of such faces go back to where they are in the mesh, until there are none.
  void take_back(std::vector<Vector3>& positions) const;

 private:
  struct Pair {
    Index first;
    Index second;
    double cosine;
  };

  [[nodiscard]] double cosine(const Pair& pair, const std::vector<Vector3>& at) const;
  [[nodiscard]] bool is_turned(const Pair& pair, const std::vector<Vector3>& at) const;

  const PolygonMesh& mesh_;
  std::vector<Pair> pairs_;
};

/// Whether a face that has an area in the mesh has next to none with nodes at `positions`. Cost: linear.
bool loses_area(const PolygonMesh& mesh, const std::vector<Vector3>& positions);

}  // namespace vspring
