#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The places of the nodes of a surface's net in the input, after noise is removed from their spacing. Some sweeps move
/// nodes to the mean of their neighbours, weighted by the inverse square of the mesh's length towards each. Held nodes
/// stay. Roughness within about three edges goes; aspects and gradings of cells stay, so the shape of a lathe does not
/// sink between wide cells. If noise has flipped many faces there are more sweeps. Bricks become hexagons. Cost:
/// linear; the same result on any number of threads.
std::vector<Vector3> rest_positions(const Net& net, ThreadTeam& team);

/// rest_positions(), if the input still shows how nodes are spaced. None if noise of several edges has flipped faces at
/// random.
std::optional<std::vector<Vector3>> told_rest_positions(const Net& net, ThreadTeam& team);

}  // namespace vspring
