#pragma once

#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Places of the nodes of sharp edges by the sides.
struct SidePlaces {
  std::vector<Vector3> positions;   ///< of all nodes of the mesh
  std::vector<Index> corners = {};  ///< where three sides or more meet
  double deviation = 0;             ///< about what is left of the noise in each direction across a chain
};

/// Puts each node of sharp edges where the sides meet; along the chain it keeps its place. A side is a plane or a
/// quadratic, fitted to two to eight rings of its nodes: the least uncertain one there of those whose residuals are no
/// more than noise; a plane only if it misses no bend. cut, origin: the mesh cut along the edges, see MeshOfSheets.
/// noise: the standard deviation of its nodes in each coordinate. Cost: linear in these nodes.
SidePlaces places_by_sides(const PolygonMesh& mesh, const PolygonMesh& cut, const std::vector<Index>& origin,
                           double noise);

}  // namespace vspring
