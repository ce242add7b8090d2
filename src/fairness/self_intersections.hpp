#pragma once

#include "base/threads.hpp"
#include "vspring/self_intersections.hpp"

namespace vspring {

/// As the public one, on a team of threads.
std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context,
                                                        ThreadTeam& team);

/// How many pairs these are. In a mesh of triangles none is kept: of crumpled ones there are many more than nodes.
std::size_t count_self_intersections(const PolygonMesh& mesh, const Context& context, ThreadTeam& team);

}  // namespace vspring
