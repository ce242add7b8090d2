#pragma once

#include "spring/net.hpp"

namespace vspring {

/// κ of F ≈ −κ L² h, V-Spring on a nearly flat surface whose mesh is like this one, h heights and L h the mean of a
/// node's neighbours less its own: 3/4 on triangles, 1 on quads.
double bending_factor(const Net& net);

}  // namespace vspring
