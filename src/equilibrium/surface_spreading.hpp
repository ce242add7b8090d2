#pragma once

#include "base/threads.hpp"
#include "levels/levels.hpp"
#include "linear/interpolation.hpp"
#include "linear/linear_solver.hpp"
#include "precondition/tangential_rigid_modes.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Moves the nodes of a surface, handed up from a coarser level, along it to where the regularisation (§4.4) wants
/// them. spreading: of the tangential_laplacian() of the net. Needs directions, and sets them. Cost: linear.
void spread_along(Net& net, LinearSolver& spreading, const TangentialRigidModes& rigid_modes, ThreadTeam& team);

/// Moves the nodes of a coarser level along its surface to where the regularisation of the finer one wants them, at a
/// quarter of the cost on the finer one. between: of the two; spreading: of the finer one. Needs directions on the
/// coarser one, and sets them. False where nothing is to be moved, or the solver has no coarser level. Cost: linear.
bool spread_coarser(Net& coarse, const Net& fine, const Interpolation& between, LinearSolver& spreading,
                    ThreadTeam& team);

}  // namespace vspring
