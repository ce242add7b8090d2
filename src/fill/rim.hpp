#pragma once

#include <vector>

#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// The face at an edge of a rim, which runs along it in the opposite direction; −1 if there is none.
Index face_beside(const PolygonMesh& mesh, const Incidence& incidence, Index from, Index to);

/// As the public find_holes(), with the incidence known.
std::vector<Hole> find_holes(const PolygonMesh& mesh, const Incidence& incidence);

/// "the hole at node 17", as all messages call it.
std::string called(const Hole& hole);

}  // namespace vspring
