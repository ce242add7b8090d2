#pragma once

#include "spring/net.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The faces in the rings of a net, cut into triangles, over its local nodes. Polygons are cut so that edges spread
/// evenly over the nodes: by connectivity alone, so that a moved copy is cut alike. Cost: linear; within a face n log
/// n.
PolygonMesh triangulated_patch(const Net& net);

}  // namespace vspring
