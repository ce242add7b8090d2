#pragma once

#include <utility>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// Finds the pairs of faces that cross: each passes through the other along some length. Faces that only touch, to
/// within the rounding of coordinates, do not count; nor do two that share an edge (SurfaceFigures::flipped_faces shows
/// such folds). Faces that are not flat are split into triangles, quads by either diagonal (docs/fairness.md).
///
/// Returns each pair once, the smaller face first, in ascending order; the same for every number of threads. Cost:
/// linear if every line along some direction meets the surface at most once, as for most caps and patches; otherwise n
/// log n plus the number of pairs of faces with overlapping boxes. Around a node of very many faces, only pairs whose
/// far edges overlap as seen from the node count. When cancelled, returns the pairs found so far.
[[nodiscard]] std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context);
[[nodiscard]] std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh);

}  // namespace vspring
