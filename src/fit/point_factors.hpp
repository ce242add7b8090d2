#pragma once

#include "fit/point_ties.hpp"

namespace vspring {

/// What shapes bend by against what their points ask, for points whose weights are shares of one pull on the whole
/// shape: the sum of a node's weights times ℓ² on surfaces, ℓ³ on curves (ℓ the mean length of its edges), for however
/// many nodes.
PointFactors pull_by_sums();

/// The power of the length of edges in that.
double pull_power(const Net& net);

}  // namespace vspring
