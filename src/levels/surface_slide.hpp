#pragma once

#include <span>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Moves the moving nodes along the surface that they form, each by about its step, which may be many edges long, to
/// where the V-Springs to the nodes there balance. That is exact on spheres; elsewhere the error is of third order in
/// the spacing. Needs directions, and sets them. Cost: linear in the nodes and the edges on the way.
void slide(Net& net, std::span<const Vector3> steps, ThreadTeam& team);

}  // namespace vspring
