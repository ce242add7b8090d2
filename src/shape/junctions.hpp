#pragma once

#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The lines along which three faces meet, as chains of the mesh's nodes from one place where such lines meet or end to
/// the next, or closed. Where four do, solids touch. Cost: n log n.
PolygonCurve junction_lines(const PolygonMesh& mesh);

}  // namespace vspring
