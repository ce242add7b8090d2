#pragma once

#include <optional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/refine.hpp"

namespace VSPRING_API vspring {

/// What triangles remesh() makes.
struct Remeshing {
  /// About the length of their edges, in units of the mesh; greater than 0. Empty: the median edge of the part.
  std::optional<double> length = std::nullopt;
  /// Edges of the mesh that stay lines of it, such as sharp ones: nodes move along them only, and faces never cross
  /// them. Those that no face of the part has stay as they are.
  MeshEdges lines = {};

  /// Throws Error(invalid_argument) unless the length is greater than 0 and finite.
  void validate() const;
};

/// A mesh of which a part has new triangles, and what its nodes may do.
struct Remeshed : Refined {
  double length = 0;  ///< given, or the median edge
  /// The edges along the given lines, the lower node first; ascending.
  MeshEdges lines = {};
  /// Per edge of `lines` one of the given ones of its chain: the first, by its number in Remeshing::lines.
  std::vector<Index> line_from = {};
};

/// Gives the part of a mesh that moves even triangles, for meshes with needles, or with edges of which some are far too
/// long or too short. Ten times, edges longer than 4/3 of `length` are halved, edges shorter than 4/5 of it collapsed,
/// edges flipped so that six triangles meet at a node, and nodes moved to the middle of the triangles around and back
/// onto the input (M. Botsch, L. Kobbelt, A remeshing approach to multiresolution modeling, 2004). The part is that of
/// refine(). Its polygons become triangles.
///
/// Nodes that are held, slide or have a given normal stay, and so do corners: nodes where lines meet or end, or where a
/// line or the boundary turns by more than 60°. Edges between the part and other faces stay. New nodes on a boundary
/// edge between held nodes do what both do, as with refine(). Where edges that stay are longer or shorter than
/// `length`, others near them are, too: by half of the distance less. Other nodes lie on the input: on its faces, on
/// its boundary, or on their line; a few stay off it, by at most a tenth of an edge, where a face would fold. No face
/// turns by more than 60° in a step, no new edge joins more than two faces, and no hole closes.
///
/// Nodes that stay come first, in their order; faces that stay are the same. Throws what Remeshing::validate() throws;
/// Error(unusable_constraint) for constraints of another number of nodes; Error(unusable_shape) naming a face of the
/// part and its node if a coordinate is not finite; Error(invalid_argument) for a line with a node that the mesh does
/// not have, for a median edge without length, and for more than most_new_nodes new nodes. Cost: n log n, some 100 µs
/// for every new node. The same bits for every number of threads.
[[nodiscard]] Remeshed remesh(const PolygonMesh& mesh, const Constraints& constraints, const Remeshing& how);

}  // namespace vspring
