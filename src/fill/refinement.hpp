#pragma once

#include <array>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Triangles over a hole.
struct Patch {
  std::vector<Vector3> places;                  ///< of the nodes: first the rim, then new ones
  std::vector<Vector3> flat;                    ///< their places on the triangles over the rim
  std::vector<double> spacing;                  ///< per node, the length that edges should have there
  std::vector<Index> like;                      ///< per node, a node of the rim near it
  std::vector<std::array<Index, 3>> triangles;  ///< consistently oriented; each edge is in two of them, at the rim in
                                                ///< one
};

/// Splits triangles at their centroids until they are as dense as `spacing`, which is interpolated for new nodes. Swaps
/// inner edges whose opposite angles sum up to more than 180°, unless faces would fold (Liepa 2003, §3). If there are
/// new nodes, edges across the patch from rim to rim that are not short are then cut in two, so that no triangle has
/// all its nodes on the rim, and short ones that are sharp are swapped where one of their triangles has. joined: as
/// Rim::joined, edges that are never made. Ends if the thread's context is cancelled. Cost: n log n in the result.
/// Returns whether anything changed.
bool refine(Patch& patch, const std::vector<std::vector<Index>>& joined);

}  // namespace vspring
