#pragma once

#include <vector>

#include "base/threads.hpp"
#include "levels/level.hpp"
#include "spring/model.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// The hierarchy of a surface, the coarsest level first, the surface itself last. Coarser levels are triangulations of
/// about a quarter of the nodes, with constraints and boundary loops of their own; they follow from connectivity and
/// constraints alone. Levels are added down to about twenty moving nodes. With Distribution::keep the shares of the
/// finest net follow from the present places; those of other nets, and all with Distribution::smooth, follow from
/// rest_positions(). Cost: linear; the same result on any number of threads.
std::vector<Level> surface_levels(Net net, const Model& model, Distribution distribution, ThreadTeam& team);

/// Hands the shape of a level up to the next finer one. Missing nodes go between their parents, and from there along
/// their normal to where the V-Springs to the parents balance (Eqs. 4, 5). That is exact on spheres; elsewhere the
/// error is of third order in the spacing if that of the coarse normals is of second. Then all nodes are moved likewise
/// to where the regularisation (§4.4) wants them. Needs directions on the coarse level, sets them on the fine one.
/// Cost: linear; the same result on any number of threads.
void prolong_surface(const Level& coarse, Level& fine, ThreadTeam& team);

}  // namespace vspring
