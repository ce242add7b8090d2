#pragma once

#include <limits>
#include <vector>

#include "base/threads.hpp"
#include "shape/incidence.hpp"

namespace vspring {

/// What the edges and faces of a mesh are like.
struct MeshQuality {
  double shortest_edge = std::numeric_limits<double>::infinity();  ///< of those that have a length
  double longest_edge = 0;
  double neighbouring_edge_spread = 1;                              ///< at one node
  double smallest_angle = std::numeric_limits<double>::infinity();  ///< radians; at corners between two edges of some
  double greatest_angle = 0;                                        ///< length
  Index flipped_faces = 0;
  Index zero_length_edges = 0;
  Index zero_area_faces = 0;

  void add(const MeshQuality& other);
};

/// Of the faces with a mark. A face is flipped where at each of its nodes it points against the vector area of the
/// faces around that node, which stays the same wherever the node lies within a closed fan. Nodes that are not
/// oriented, being non-manifold or between faces that disagree in their sense, have no say, so no face there is called
/// flipped.
MeshQuality mesh_quality(const PolygonMesh& mesh, const Incidence& incidence, const std::vector<Vector3>& positions,
                         const std::vector<std::uint8_t>& marked_faces, const std::vector<std::uint8_t>& oriented_nodes,
                         ThreadTeam& team);

}  // namespace vspring
