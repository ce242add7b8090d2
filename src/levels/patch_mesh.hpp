#pragma once

#include "spring/net.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The faces that nodes with rings look at, cut into triangles, over the local nodes of a net. Polygons are cut so that
/// edges spread evenly over the nodes: by connectivity alone, so that a moved copy is cut alike. Cost: linear; within a
/// face n log n.
PolygonMesh triangulated_patch(const Net& net);

}  // namespace vspring
