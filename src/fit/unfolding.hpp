#pragma once

#include "base/threads.hpp"
#include "spring/net.hpp"
#include "vspring/context.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Takes the noise that folds a surface off its moving nodes: without_noise(), of as much as estimate_noise() tells of
/// the mesh. Leaves them as they are where fewer than one edge in 200 turns by more than 90°, which may be what the
/// shape is like, or more than a tenth of these go on turning. Held nodes stay. Cost: linear; the same result on any
/// number of threads.
void unfold(Net& net, const PolygonMesh& mesh, const Context& context, ThreadTeam& team);

}  // namespace vspring
