#pragma once

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "equilibrium/hierarchy.hpp"
#include "equilibrium/point_levels.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// The paper's V-cycle (§4.7): on the way down a few iterations on each level, the coarsest one to its equilibrium, on
/// the way up each level until the termination condition of §4.6 holds. Fills outcome, iterations, residual, history
/// and levels. points: of the levels, if any; each level ties them anew every few iterations (§4.5).
void run_multigrid(Hierarchy& hierarchy, const Model& model, const FairOptions& options, ThreadTeam& team,
                   Context& context, ProgressReporter& progress, FairReport& report, PointLevels* points = nullptr);

}  // namespace vspring
