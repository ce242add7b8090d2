#pragma once

#include <cstdint>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Nodes inside flat ends of a surface of voxels, 1 each: terraces around which the surface goes down by three voxels
/// or more, for four fifths of their rim. A curved surface has terraces, too, but goes down from them in single steps.
/// size: of the voxels. Cost: n log n.
std::vector<std::uint8_t> nodes_of_flat_ends(const PolygonMesh& mesh, const Vector3& size);

}  // namespace vspring
