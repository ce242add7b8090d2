#pragma once

#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// A mesh whose nodes at about the same place are one. Nodes and faces keep their numbers, so constraints, regions,
/// messages and reports speak of those of the input.
struct Welded {
  /// Faces have, of nodes that are one, the node that stands for them; the others belong to no face any more. Corners
  /// that so repeat the one before are left out, and a face with fewer than three left has none.
  PolygonMesh mesh;
  /// Of every node the one that stands for it: of those that are one the first; itself where it is alone.
  std::vector<Index> stands_for;
  Index joined = 0;              ///< nodes that another one stands for
  double tolerance = 0;          ///< nodes that are no further apart are one; in units of the input
  std::vector<Index> collapsed;  ///< faces that had three corners at different places and have no more; ascending

  /// Positions for all nodes, from those that the mesh has got: what is one moves to one place, and where it did not
  /// move all keep their own, bit for bit. Throws Error(invalid_argument) unless there is one position per node.
  /// Cost: linear.
  [[nodiscard]] std::vector<Vector3> positions(const std::vector<Vector3>& of_mesh) const;
};

/// Makes nodes one that are no further apart than `tolerance` times the diagonal of the box around the faces, and those
/// that hang together so; 0, and what is below 1e-16, joins nodes at the same place alone. Which nodes are one does not
/// depend on their order. Nodes of no face and such that are not finite stay by themselves. Faces that have fewer than
/// three nodes stay as they are; those whose corners lie at fewer than three places are no faces afterwards.
///
/// Throws Error(invalid_argument) for a tolerance that is negative or not finite, and Error(unusable_shape), naming two
/// nodes, where a chain of near nodes leads further than twice the tolerance along an axis. Cost: n log n.
[[nodiscard]] Welded weld(const PolygonMesh& mesh, double tolerance);

/// What shows that a mesh came in pieces that were meant to be one.
struct Seams {
  Index lone_faces = 0;           ///< that share no edge with another
  std::vector<Index> same;        ///< boundary nodes at the place of another one, ascending
  std::vector<Index> near_nodes;  ///< those, and such as are within the tolerance of another one; ascending
};

/// Looks for seams. tolerance: as for weld(); where chains of near nodes lead further, nodes at the same place alone
/// are named. Throws Error(invalid_argument) as weld() does. Cost: n log n for the nodes of the boundary, else linear.
[[nodiscard]] Seams find_seams(const PolygonMesh& mesh, double tolerance = 1e-6);

}  // namespace vspring
