#pragma once

#include "base/threads.hpp"
#include "vspring/self_intersections.hpp"

namespace vspring {

/// As the public one, on a team of threads.
std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context,
                                                        ThreadTeam& team);

}  // namespace vspring
