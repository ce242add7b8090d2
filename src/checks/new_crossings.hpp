#pragma once

#include <string>
#include <vector>

#include "base/threads.hpp"
#include "vspring/context.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Describes faces that cross each other with the nodes at `positions`, if more do than in the mesh; empty otherwise,
/// and when cancelled. Looks at the faces that moved and at those around them. Cost: linear in the mesh, and as
/// self_intersections() of these faces.
std::string new_crossings(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const Context& context,
                          ThreadTeam& team);

}  // namespace vspring
