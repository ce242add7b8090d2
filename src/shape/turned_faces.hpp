#pragma once

#include <cstdint>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// 1 for faces to turn over so that neighbours at edges of two faces go round in one sense, as far as the surface has
/// two sides; the first face of each part keeps its own. Cost: n log n.
std::vector<std::uint8_t> turned_faces(const PolygonMesh& mesh);

}  // namespace vspring
