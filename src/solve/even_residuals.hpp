#pragma once

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Lets points that are the nodes of a surface themselves (TiedPoints::are_nodes) pull more where the shape misses them
/// by more than noise does, and less where by less: the mean of their distances across the shape over a node, its
/// neighbours and theirs, n points, is about noise/√n where only noise is left. noise: its standard deviation across
/// the shape, in the coordinates of the net. Needs directions. Cost: linear; the same result on any number of threads.
void even_residuals(Net& net, double noise, ThreadTeam& team);

/// Root mean square of those distances. Needs directions. Cost: linear.
double rms_residual(const Net& net);

}  // namespace vspring
