#pragma once

#include <cstddef>
#include <cstdint>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Whether edges that only touch, as at nodes in the same place, cross each other. Curves that cross exactly at nodes
/// cross. Where touching does not count, moving a node by a rounding error makes no crossing.
enum class Touching : std::uint8_t { does_not_count, counts };

/// The number of pairs of edges of a plane curve that cross each other, edges between held nodes left out; 0 for a
/// curve in space. Cost: n log n, and more for edges of very different lengths.
std::size_t curve_crossings(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team,
                            Touching touching = Touching::does_not_count);

}  // namespace vspring
