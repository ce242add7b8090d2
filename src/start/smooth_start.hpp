#pragma once

#include "spring/curve_net.hpp"

namespace vspring {

/// A start for a curve that points pull at: the smoothing spline of the points' means over the lengths that its edges
/// have now, each coordinate by itself, so that no noise is too much for it. pull: the k of every moving node (Eq. 9);
/// no node smooths by more than some thirty edges. Given tangents are kept. Cost: linear.
void start_smooth(Net& net, const std::vector<double>& pull);

}  // namespace vspring
