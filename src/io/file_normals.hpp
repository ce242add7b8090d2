#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// New values for normals of a file.
struct NewNormals {
  std::vector<std::uint8_t> due;  ///< per normal of the file, whether it has a new value
  std::vector<Vector3> normals;   ///< unit length where due
};

/// Computes anew the normals at corners of faces with a moved node. A normal is the sum, over its corners, of the cross
/// product of the corner's two edges divided by the product of their squared lengths (N. Max, Weights for computing
/// vertex normals from facet normals, 1999). So normals of faces, of nodes and of sharp edges each stay of their kind;
/// equal normals at one place, as along a seam, stay equal. If most of the file's normals are opposite to its faces, so
/// are the new ones.
///
/// corner_normals: the file's normal for each corner of the mesh, −1 for none. before: the file's normals.
/// positions: one per node. A normal whose corners give no direction is not due. Cost: n log n.
NewNormals compute_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                           std::span<const Vector3> before, std::span<const Vector3> old_positions,
                           std::span<const Vector3> positions, std::span<const std::uint8_t> moved);

/// The normals of nodes added behind the `before` ones, as compute_normals() computes them from all faces there, in
/// their sense; if that gives no direction, the normal of the node in `like`. Cost: n log n.
std::vector<Vector3> normals_of_added(const PolygonMesh& mesh, std::span<const Vector3> before,
                                      const std::vector<Vector3>& positions, std::span<const Index> like);

/// The normals of a file, with one for each place that needs its own where a normal is shared.
struct PartedNormals {
  std::vector<Index> of_corner;  ///< per corner its part, −1 for none
  std::vector<Index> of_file;    ///< per part the normal of the file; each normal itself first, in its order
};

/// Parts normals that several nodes or faces name, as a plane does with its only normal: by nodes, except where a face
/// alone names it, as flat shading does. Arguments as for compute_normals(). Cost: n log n; linear without any.
PartedNormals part_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals, std::size_t normal_count);

/// Sums file normals at nodes: one unit vector per node, zero where the corners have none.
std::vector<Vector3> node_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                                  std::span<const Vector3> normals);

/// The vector at unit length, or zero if it has no direction.
Vector3 unit_or_zero(const Vector3& vector);

}  // namespace vspring
