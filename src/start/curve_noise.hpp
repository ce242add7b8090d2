#pragma once

#include "spring/curve_net.hpp"

namespace vspring {

/// Removes noise about as long as edges from the moving nodes: where the curve turns sharply to and fro, averages nodes
/// with their neighbours until it does not. A bend of few edges stays, as do held nodes and nodes with a given
/// direction. Cost: linear for each round, at most 30.
void smooth_noise(Net& net);

}  // namespace vspring
