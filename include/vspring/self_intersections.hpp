#pragma once

#include <utility>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// The pairs of faces that cross: each reaches from one side of the other to its other side, along some length. Faces
/// that only touch, to within the rounding of coordinates, do not count, nor do two that share an edge (flipped faces
/// show such folds). Faces that are not flat are taken as triangles, quads by either diagonal (docs/fairness.md).
///
/// Each pair once, the smaller face first, in ascending order; the same for every number of threads. Cost: linear
/// where one direction sees every point once, as of most caps and patches; otherwise n log n, and the number of pairs
/// of faces with overlapping boxes, around a node of very many faces of those whose far edges, seen from it, have. When
/// cancelled, only the pairs found so far.
[[nodiscard]] std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context);
[[nodiscard]] std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh);

}  // namespace vspring
