#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Where the nodes of a surface's net lie in the input once its noise is taken out of their spacing: after some sweeps
/// to the mean of neighbours, which count by the inverse square of how long the mesh is towards them. Held nodes stay.
/// Rough spacing goes within some three edges; aspects and gradings of cells stay, so the shape of a lathe does not
/// sink between wide cells. Where noise is so long that it has turned many faces over, there are more sweeps. Bricks
/// become hexagons. Cost: linear; the same result on any number of threads.
std::vector<Vector3> rest_positions(const Net& net, ThreadTeam& team);

/// The same where the input of a surface's net tells how nodes are to be spaced; else none: noise of several edges
/// turns faces over as it likes, and leaves nothing of it.
std::optional<std::vector<Vector3>> told_rest_positions(const Net& net, ThreadTeam& team);

}  // namespace vspring
