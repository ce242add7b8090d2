#pragma once

#include <array>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// The rim of a hole.
struct Rim {
  std::vector<Vector3> places;  ///< of its nodes, in the order in which faces that fill it run
  /// Unit normal of the face beside the edge from each node to the next; zero where it has none, and no say.
  std::vector<Vector3> normals;
  /// The other nodes of the rim to which an edge that is not of the rim leads from each outside already, ascending.
  std::vector<std::vector<Index>> joined;
};

/// Triangles over the nodes of a rim.
struct RimTriangles {
  std::vector<std::array<Index, 3>> triangles;  ///< none where there is no triangulation
  bool is_folded = false;                       ///< somewhere by more than 175°, or a triangle has no area
};

/// Edges of a rim up to which the best triangulation of all is looked for; of longer ones ears are cut off first.
inline constexpr std::size_t most_edges_at_once = 500;

/// The triangulation whose greatest dihedral angle is least, then whose area is least (Barequet and Sharir 1995; Liepa
/// 2003, §2), among those without an edge that is there already. Angles are compared to 1e-7 of 1 − cos, so that
/// rounding does not decide where patches are flat. Ends where the thread's context is cancelled. Cost: cubic in up to
/// most_edges_at_once edges; n log n in those above.
/// at_once: that limit, for tests.
RimTriangles triangulate(const Rim& rim, std::size_t at_once = most_edges_at_once);

}  // namespace vspring
