#pragma once

#include "spring/curve_net.hpp"

namespace vspring {

/// Takes out of the moving nodes the noise that is about as long as edges are: averages nodes and their neighbours
/// where the curve turns sharply to and fro, and nowhere else, until it does not. A bend of few edges stays, as do held
/// nodes and nodes with a given direction. Cost: linear for each round, at most 30.
void smooth_noise(Net& net);

}  // namespace vspring
