#pragma once

#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/refined_mesh.hpp"

namespace VSPRING_API vspring {

/// A mesh with nodes at about the same place joined. Nodes and faces keep their numbers, so constraints, regions,
/// messages and reports use those of the input.
struct Welded {
  /// In its faces, the first node of each group of joined nodes represents the group; the others belong to no face. A
  /// face lists no node twice in a row; with fewer than three corners left it is empty.
  PolygonMesh mesh;
  /// Per node the node that represents it: the first of its group, or itself.
  std::vector<Index> representative;
  Index joined = 0;              ///< number of nodes that another one represents
  double tolerance = 0;          ///< distance up to which nodes are joined; in units of the input
  std::vector<Index> collapsed;  ///< faces whose corners were at three or more places and are now at fewer; ascending

  /// Positions for all nodes, given those of `mesh`. Joined nodes get the position of their representative; if it did
  /// not move, they keep their own bit for bit. Throws Error(invalid_argument) unless there is one position per node.
  /// Cost: linear.
  [[nodiscard]] std::vector<Vector3> positions(const std::vector<Vector3>& of_mesh) const;

  /// The input with its faces divided as those of `mesh` are: where nodes are joined, it gets a new node on each side.
  /// New nodes lie at the means of the input's own. input: what was welded. refined: of `mesh`. Throws
  /// Error(unusable_shape) naming a divided face of which welding has joined two nodes. Cost: linear.
  [[nodiscard]] RefinedMesh unwelded(const PolygonMesh& input, const RefinedMesh& refined) const;
};

/// Joins nodes that are at most `tolerance` times the diagonal of the box around the faces apart, and chains of such
/// nodes. Below 1e-16 only nodes at the same place are joined. The result does not depend on the order of the nodes.
/// Nodes of no face, and nodes that are not finite, are not joined. Faces with fewer than three nodes stay as they are.
///
/// Throws Error(invalid_argument) for a tolerance that is negative or not finite, and Error(unusable_shape), naming two
/// nodes, where a chain of near nodes leads further than twice the tolerance along an axis. Cost: n log n.
[[nodiscard]] Welded weld(const PolygonMesh& mesh, double tolerance);

/// Signs that a mesh consists of pieces that should be joined.
struct Seams {
  Index lone_faces = 0;           ///< faces that share no edge with another
  std::vector<Index> same;        ///< boundary nodes at the place of another one; ascending
  std::vector<Index> near_nodes;  ///< boundary nodes within the tolerance of another one; ascending
};

/// Looks for seams. tolerance: as for weld(). Where weld() would refuse a chain of near nodes, only nodes at the same
/// place are listed. Throws Error(invalid_argument) as weld() does. Cost: n log n for the nodes of the boundary, else
/// linear.
[[nodiscard]] Seams find_seams(const PolygonMesh& mesh, double tolerance = 1e-6);

}  // namespace vspring
