#pragma once

#include "base/threads.hpp"
#include "spring/net.hpp"
#include "vspring/context.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Takes the noise that folds a surface off its moving nodes: without_noise(), by the estimate of estimate_noise() for
/// the mesh. Leaves them as they are where fewer than one edge in 200 turns by more than 90°, as these may belong to
/// the shape, or where more than a tenth of these still turn afterwards. Held nodes stay. Cost: linear; the same result
/// on any number of threads.
void unfold(Net& net, const PolygonMesh& mesh, const Context& context, ThreadTeam& team);

}  // namespace vspring
