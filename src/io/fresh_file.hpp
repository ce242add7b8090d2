#pragma once

#include <span>
#include <string>
#include <vector>

#include "vspring/scalar_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring {

/// A file made from nothing but a mesh. normals: one per node, or none. losses: what the format cannot hold is added.
/// PLY is binary, little-endian, in double precision; STL is binary, its faces cut into triangles from their first
/// node.
std::string fresh_file(SurfaceFormat format, const PolygonMesh& mesh, std::span<const Vector3> positions,
                       std::span<const Vector3> normals, std::vector<std::string>& losses);

/// The PLY of fresh_file() with more numbers at nodes, a value per node each.
std::string fresh_ply(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals,
                      std::span<const NodeScalar> scalars);

}  // namespace vspring
