#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/threads.hpp"
#include "vspring/self_intersections.hpp"

namespace vspring {

/// As the public one, on a team of threads.
std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context,
                                                        ThreadTeam& team);

/// Pairs beyond which it makes no difference how many there are: a crumpled mesh has a hundred times as many as nodes.
inline constexpr std::size_t most_counted_crossings = 1'000'000;

/// How many pairs these are, counted to `most`. In a mesh of triangles none is kept.
std::size_t count_self_intersections(const PolygonMesh& mesh, const Context& context, ThreadTeam& team,
                                     std::size_t most = most_counted_crossings);

}  // namespace vspring
