#pragma once

#include <vector>

#include "span/loops.hpp"
#include "vspring/constraints.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

/// A run of half-arcs along which a surface ends, and the nodes there.
struct SurfaceEnd {
  std::vector<Index> halves;
  bool is_closed = false;  ///< whether the last goes on smoothly as the first
  /// Per half-arc, those that cross or meet the run where it begins and, in the last entry, where the last one ends.
  std::vector<std::vector<Index>> crossing;
};

/// Finds where surfaces end: along arcs with a spanned loop on one side, and on both sides of sharp arcs. A run ends
/// where it does not go on smoothly, and where sharp arcs begin or end. loops: the spanned ones. is_sharp: per arc.
/// Cost: linear.
std::vector<SurfaceEnd> find_ends(const Arcs& arcs, const std::vector<Loop>& loops,
                                  const std::vector<std::uint8_t>& is_sharp);

/// The unit normals along a run of nodes of a surface that has known normals at some of them: perpendicular to the run,
/// and turned about it by a cubic of arc length between. Empty if none is known.
///
/// places: of the nodes; of a closed run, the first again at the end. tangents: of the run there. known: per node, zero
/// where not known; either sense will do. about: per node roughly the normal, which tells how far normals turn
/// between two known ones; zero where it is not known. Cost: linear.
std::vector<Vector3> normals_along(const std::vector<Vector3>& places, const std::vector<Vector3>& tangents,
                                   const std::vector<Vector3>& known, const std::vector<Vector3>& about);

}  // namespace vspring
