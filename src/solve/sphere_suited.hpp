#pragma once

#include "spring/net.hpp"

namespace vspring {

/// Whether sphere springs may be used in a net that was gathered for them. Not where the boundary moves
/// but for nodes that slide, where an equilibrium is one of a family, or where a normal is given with moving nodes on
/// more sides of the node than one: a sphere touches a surface whose slope jumps by as much on both sides as well as
/// one that does not, and the normal would have no say. Cost: linear.
bool suits_sphere_springs(const Net& net);

}  // namespace vspring
