#pragma once

#include <limits>
#include <vector>

#include "base/threads.hpp"
#include "shape/incidence.hpp"

namespace vspring {

/// Figures of the edges and faces of a mesh.
struct MeshQuality {
  double shortest_edge = std::numeric_limits<double>::infinity();  ///< of those with a length
  double longest_edge = 0;
  double neighbouring_edge_spread = 1;                              ///< at one node
  double smallest_angle = std::numeric_limits<double>::infinity();  ///< radians; at corners between two edges of some
  double greatest_angle = 0;                                        ///< length
  Index flipped_faces = 0;
  Index zero_length_edges = 0;
  Index zero_area_faces = 0;

  void add(const MeshQuality& other);
};

/// Measures the marked faces. A face is flipped if, at each of its nodes, it is opposite to the vector area of the
/// faces around that node; within a closed fan that does not depend on the place of the node. A face with a node that
/// is not oriented (non-manifold, or between inconsistently oriented faces) does not count as flipped.
MeshQuality mesh_quality(const PolygonMesh& mesh, const Incidence& incidence, const std::vector<Vector3>& positions,
                         const std::vector<std::uint8_t>& marked_faces, const std::vector<std::uint8_t>& oriented_nodes,
                         ThreadTeam& team);

}  // namespace vspring
