#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Normals that a file gave and that have to be computed anew.
struct NewNormals {
  std::vector<std::uint8_t> due;  ///< per normal of the file: has a new value
  std::vector<Vector3> normals;   ///< unit length where due
};

/// Computes those normals anew that belong to a corner of a face of which a node moved: the sum over the corners of a
/// normal of the cross product of the corner's two edges, divided by the product of their squared lengths
/// (N. Max, Weights for computing vertex normals from facet normals, 1999). Normals of single faces, of nodes and of
/// sharp edges each stay of their kind so; those that were equal at one place, as along a seam, stay equal. Where most
/// of the file's normals point against its faces, the new ones do.
///
/// corner_normals: the file's normal for each corner of the mesh, −1 for none. before: the file's normals.
/// positions: one per node. A normal whose corners give no direction is not due. Cost: n log n.
NewNormals compute_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                           std::span<const Vector3> before, std::span<const Vector3> old_positions,
                           std::span<const Vector3> positions, std::span<const std::uint8_t> moved);

/// Of every node that came to a mesh behind those with `before`, as compute_normals() does it from all faces there, in
/// their sense; where that gives no direction, the normal of its node of `like`. Cost: n log n.
std::vector<Vector3> normals_of_added(const PolygonMesh& mesh, std::span<const Vector3> before,
                                      const std::vector<Vector3>& positions, std::span<const Index> like);

/// Sums file normals at nodes: one unit vector per node, zero where the corners have none.
std::vector<Vector3> node_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                                  std::span<const Vector3> normals);

/// Unit length, or zero for a vector that has no direction.
Vector3 unit_or_zero(const Vector3& vector);

}  // namespace vspring
