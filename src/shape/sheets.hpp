#pragma once

#include <span>
#include <utility>
#include <vector>

#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The lines along which three faces meet at edges, as chains of nodes of the mesh: open ones between places where
/// lines meet or end, or closed ones. Edges of four faces, where solids touch, do not count. Cost: n log n.
PolygonCurve junction_lines(const PolygonMesh& mesh);

/// A mesh in which each sheet has its own copy of a node where sheets meet.
struct MeshOfSheets {
  PolygonMesh mesh;
  std::vector<Index> origin;  ///< per added node, the node that it copies
};

/// Cuts a mesh at nodes. Around each, faces stay together if they share an edge of two faces that is not among
/// `sharp`; these are ascending, the smaller node first. Faces keep their numbers and nodes. A node that occurs in a
/// face more than once stays one. Cost: n log n.
MeshOfSheets into_sheets(const PolygonMesh& mesh, std::span<const Index> nodes,
                         std::span<const std::pair<Index, Index>> sharp = {});

}  // namespace vspring
