#pragma once

#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The edges of two faces between any two of these nodes, except inside: where both faces have such nodes only. So of a
/// row of nodes they are its edges, and of a group those at its rim. named_nodes: faces with a node beyond these are
/// mirror images, which are inside where the face beside them is. Ascending. Cost: n log n.
MeshEdges edges_between(const PolygonMesh& mesh, const std::vector<Index>& nodes, Index named_nodes);

}  // namespace vspring
