#pragma once

#include <array>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// The rim of a hole.
struct Rim {
  std::vector<Vector3> places;  ///< of its nodes, in the order in which faces that fill it run
  /// Unit normal of the face at the edge from each node to the next; zero if it has none, and is then ignored.
  std::vector<Vector3> normals;
  /// Per node the other rim nodes to which an edge exists already outside, not along the rim; ascending.
  std::vector<std::vector<Index>> joined;
};

/// Triangles over the nodes of a rim.
struct RimTriangles {
  std::vector<std::array<Index, 3>> triangles;  ///< empty if there is no triangulation
  bool is_folded = false;                       ///< whether it folds by more than 175° somewhere, or a triangle has no
                                                ///< area
};

/// Rims of more edges have ears cut off first; then the best triangulation is found.
inline constexpr std::size_t most_edges_at_once = 500;

/// Returns the triangulation with the least greatest dihedral angle, of equal ones that of least area (Barequet and
/// Sharir 1995; Liepa 2003, §2), without edges that exist already. Angles are compared to 1e-7 of 1 − cos, so that
/// rounding does not decide on flat patches. Ends if the thread's context is cancelled. Cost: cubic in up to
/// most_edges_at_once edges; n log n in those above. at_once: that limit, for tests.
RimTriangles triangulate(const Rim& rim, std::size_t at_once = most_edges_at_once);

}  // namespace vspring
