#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/threads.hpp"
#include "vspring/self_intersections.hpp"

namespace vspring {

/// As the public self_intersections(), on a team of threads.
std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context,
                                                        ThreadTeam& team);

/// Counting stops here: a crumpled mesh has a hundred times as many pairs as nodes.
inline constexpr std::size_t most_counted_crossings = 1'000'000;

/// The number of pairs, up to `most`. In a mesh of triangles no pairs are stored.
std::size_t count_self_intersections(const PolygonMesh& mesh, const Context& context, ThreadTeam& team,
                                     std::size_t most = most_counted_crossings);

}  // namespace vspring
