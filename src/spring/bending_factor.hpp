#pragma once

#include "spring/net.hpp"

namespace vspring {

/// κ of F ≈ −κ L² h: the V-Spring force F on a nearly flat surface with such a mesh; h: heights; L h: the mean height
/// of a node's neighbours less its own. 3/4 on triangles, 1 on quads.
double bending_factor(const Net& net);

}  // namespace vspring
