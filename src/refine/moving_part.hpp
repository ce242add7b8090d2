#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The faces that refine() and remesh() change, 1 or 0 per face: those with a free node, and those beside them that
/// have all their nodes on the boundary, as in corners. Throws Error(unusable_shape) naming one of them and its node if
/// a coordinate is not finite. Cost: linear.
std::vector<std::uint8_t> moving_faces(const PolygonMesh& mesh, const Constraints& constraints);

/// The edges of other faces between nodes of these, the lower node first, ascending. Cost: n log n.
std::vector<std::pair<Index, Index>> edges_kept(const PolygonMesh& mesh, std::span<const std::uint8_t> in_part);

/// Lets a new node between two others on the boundary do what both do: held between them, sliding where they slide,
/// with the mean of their normals. length: from `a` to `b`.
void hold_between(Constraints& constraints, Index node, Index a, Index b, double length);

/// Refined::boundary_reach. Cost: linear.
double boundary_reach_of(const PolygonMesh& mesh);

}  // namespace vspring
