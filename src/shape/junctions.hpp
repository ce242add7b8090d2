#pragma once

#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The lines along which three faces meet at edges, as chains of nodes of the mesh: open ones between places where
/// lines meet or end, or closed ones. Edges of four faces, where solids touch, do not count. Cost: n log n.
PolygonCurve junction_lines(const PolygonMesh& mesh);

}  // namespace vspring
