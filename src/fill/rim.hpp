#pragma once

#include <vector>

#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// The face beside an edge of a rim, which runs along it the other way; −1 where there is none.
Index face_beside(const PolygonMesh& mesh, const Incidence& incidence, Index from, Index to);

/// As find_holes(), with what is known of the mesh.
std::vector<Hole> find_holes(const PolygonMesh& mesh, const Incidence& incidence);

/// "the hole at node 17", as all messages call it.
std::string called(const Hole& hole);

}  // namespace vspring
