#pragma once

#include <span>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// A mesh with nodes in place of one where sheets meet: each sheet has its own there.
struct MeshOfSheets {
  PolygonMesh mesh;
  std::vector<Index> origin;  ///< of each node that came to those of the mesh, in order: the one in whose place it is
};

/// Cuts a mesh at nodes: faces around one stay together where they meet along an edge of two faces. Faces keep their
/// numbers and nodes. A node that occurs in a face more than once stays one. Cost: n log n.
MeshOfSheets into_sheets(const PolygonMesh& mesh, std::span<const Index> nodes);

}  // namespace vspring
