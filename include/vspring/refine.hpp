#pragma once

#include <optional>

#include "vspring/constraints.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/refined_mesh.hpp"

namespace VSPRING_API vspring {

/// How far edges are divided: exactly one of the two.
struct Refinement {
  /// The greatest length of an edge, in units of the mesh; greater than 0.
  std::optional<double> length = std::nullopt;
  /// The greatest turn of the surface from one end of an edge to the other, between the normals of estimate_normals();
  /// in degrees, more than 0 and less than 180. Normals of new nodes are the means of those around.
  std::optional<double> turn = std::nullopt;

  /// Throws Error(invalid_argument) naming the number and its range.
  void validate() const;
};

/// More new nodes than this are refused.
inline constexpr Index most_new_nodes = 10'000'000;

/// A refined mesh, and what its nodes may do.
struct Refined : RefinedMesh {
  /// Those of the input, and behind them those of the new nodes. A new node on a boundary edge whose ends are both held
  /// is held between them; one slides where an end does, and the other one slides on the same or is held there. It has
  /// the mean of their normals if both are given. Others are free.
  Constraints constraints = Constraints(0);
  /// Two median edges of the boundary before, in units of the input, for FitOptions; 0 without a boundary.
  double boundary_reach = 0;
};

/// Divides the part of a mesh that moves, for meshes too coarse to be fair: the faces with a node whose position is
/// free, and those beside them that have all their nodes on the boundary. Edges that are too long are halved, round by
/// round, until none is left. Triangles and quads stay such: triangles are divided into two, three or four, together
/// with their longest edge (M.-C. Rivara, Algorithms for refining triangular grids, 1984), quads into two or four. The
/// opposite side of a quad is halved, too, unless it is shorter than half of what is allowed: then triangles lead from
/// the longer edges to the shorter ones. Faces of more nodes are divided around their middle, also where it is too far
/// from a node; faces that are not convex are cut into triangles, or divided around their middle where triangles would
/// fold or need an edge that is there already. No face keeps a node within an edge.
///
/// Nodes of the input keep their numbers and places. Other faces, and those with fewer than three nodes or a node
/// twice, stay, and so do edges between such a face and a moving one. Where these are longer than allowed, edges near
/// them may be, too: by half of the distance less. New nodes lie on the input; fair() makes them fair.
///
/// Throws what Refinement::validate() throws; Error(unusable_constraint) for constraints of another number of nodes;
/// Error(unusable_shape) naming a face to be divided and its node if a coordinate is not finite;
/// Error(invalid_argument) for more than most_new_nodes new nodes. Cost: linear in the nodes and faces before and
/// after. The same bits for every number of threads.
[[nodiscard]] Refined refine(const PolygonMesh& mesh, const Constraints& constraints, const Refinement& how);

}  // namespace vspring
