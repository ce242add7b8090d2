#pragma once

#include <cstddef>
#include <cstdint>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Whether edges that only touch, as at nodes in the same place, cross each other. Curves that cross at nodes do, but
/// where it is not said no move of a node by a rounding error may make a crossing.
enum class Touching : std::uint8_t { does_not_count, counts };

/// How many pairs of edges of a curve in a plane cross each other, edges between held nodes left out; 0 where it lies
/// in none. Cost: n log n, and more for edges of very different lengths.
std::size_t curve_crossings(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team,
                            Touching touching = Touching::does_not_count);

}  // namespace vspring
