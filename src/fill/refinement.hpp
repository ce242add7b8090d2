#pragma once

#include <array>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Triangles over a hole.
struct Patch {
  std::vector<Vector3> places;                  ///< of the nodes: those of the rim, and new ones behind them
  std::vector<Vector3> flat;                    ///< where they are on the triangles over the rim
  std::vector<double> spacing;                  ///< of each, the length that edges should have there
  std::vector<Index> like;                      ///< of each, a node of the rim near it
  std::vector<std::array<Index, 3>> triangles;  ///< all in one sense; each edge in two of them, or at the rim in one
};

/// Splits triangles at their centroids until they are as dense as `spacing` says, which is interpolated for new nodes,
/// and swaps edges inside the patch whose opposite angles sum up to more than 180°, unless faces would fold over
/// (Liepa 2003, §3). Where new nodes came, edges across the patch between nodes of the rim are then cut in two, so that
/// no triangle is held by the rim alone, unless they are short. joined: as of a Rim, edges that are never made. Ends
/// where the thread's context is cancelled. Cost: n log n in what comes out. Returns whether anything has changed.
bool refine(Patch& patch, const std::vector<std::vector<Index>>& joined);

}  // namespace vspring
