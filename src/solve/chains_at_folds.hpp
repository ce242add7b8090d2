#pragma once

#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The edges of those chains of sharp ones at which the surface folds with nodes at `positions`, where faces have
/// moved: at more than an eighth of their nodes a face turns over at an edge that is not sharp, or at one of the chain
/// that turns by much more than the chain does in the mesh. Ascending. Cost: n log n.
MeshEdges chains_at_folds(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const MeshEdges& sharp_edges);

}  // namespace vspring
