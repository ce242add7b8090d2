#pragma once

#include <cstdint>
#include <vector>

#include "base/threads.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Finds nodes that are far off the surface of the nodes around them, as wrong readings of a scan are. To the two rings
/// around a node, without itself, a quadratic is fitted robustly. A node is a spike if it is more than `least` standard
/// deviations off: of the noise, or of what the quadratic leaves there (the median distance over 0.6745) if that is
/// more, as at sharp edges and on coarse meshes.
///
/// candidates: one entry per node, 0 for those that are none. deviation: of the noise in each coordinate. Returns, per
/// node, 1 for spikes, but at most `most` of them, those furthest off in standard deviations. The same bits on any
/// number of threads. Cost: linear, some 20 µs a node.
std::vector<std::uint8_t> spikes_of(const PolygonMesh& mesh, const std::vector<std::uint8_t>& candidates,
                                    double deviation, double least, std::size_t most, ThreadTeam& team);

}  // namespace vspring
