#pragma once

#include <string>
#include <vector>

#include "base/threads.hpp"
#include "vspring/context.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// What to say of faces that cross each other with the nodes at `positions`, where fewer did in the mesh; empty where
/// there is nothing to say, or somebody cancels. Looks at the faces that moved and at those around them. Cost: linear
/// in the mesh, and as self_intersections() of these faces.
std::string new_crossings(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const Context& context,
                          ThreadTeam& team);

}  // namespace vspring
