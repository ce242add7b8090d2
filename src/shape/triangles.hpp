#pragma once

#include <array>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// A face, or one of the triangles that it is cut into.
struct Triangle {
  std::array<Index, 3> nodes;
  Index face;
};

/// All faces cut into triangles, each as a fan from the first of its nodes from which no triangle of the fan turns
/// over, or from its first node where there is no such node. Faces of fewer than three nodes and faces with a
/// coordinate that is not finite are left out. Cost: linear for triangles and quads; quadratic in the nodes of a face
/// that is not convex.
[[nodiscard]] std::vector<Triangle> cut_into_triangles(const PolygonMesh& mesh);

}  // namespace vspring
