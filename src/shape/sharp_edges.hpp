#pragma once

#include <vector>

#include "vspring/sharp_edges.hpp"

namespace vspring {

/// An edge of two faces, and the angle between their normals.
struct TurningEdge {
  Index first;  ///< the smaller node
  Index second;
  Index face;
  Index other_face;
  double turn;  ///< degrees
};

/// All edges of two faces with an area, in the order of their nodes. Cost: n log n.
std::vector<TurningEdge> turning_edges(const PolygonMesh& mesh);

/// The nodes of edges, ascending. Cost: n log n.
std::vector<Index> nodes_of(const MeshEdges& edges);

/// Throws Error(invalid_argument) unless it is more than 0 and less than 180 degrees.
void check_sharp_angle(double angle);

/// edges: of two faces each, ascending, the smaller node first. Cost: linear.
SharpEdges chains_of(const PolygonMesh& mesh, MeshEdges edges);

}  // namespace vspring
