#pragma once

#include <cstddef>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// How many pairs of edges of a curve in a plane cross each other, edges between held nodes left out; 0 where it lies
/// in none. Cost: n log n, and more for edges of very different lengths.
std::size_t curve_crossings(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team);

}  // namespace vspring
