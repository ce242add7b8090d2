#pragma once

#include "equilibrium/hierarchy.hpp"
#include "equilibrium/point_levels.hpp"
#include "equilibrium/solver_call.hpp"
#include "spring/model.hpp"

namespace vspring {

/// The paper's V-cycle (§4.7): on the way down a few iterations on each level, the coarsest one to its equilibrium, on
/// the way up each level until the termination condition of §4.6 holds. Fills outcome, iterations, residual, history
/// and levels. points: of the levels, if any; each level ties them anew every few iterations (§4.5).
void run_multigrid(Hierarchy& hierarchy, const Model& model, const MultigridMethod& method, const SolverCall& call,
                   PointLevels* points = nullptr);

}  // namespace vspring
