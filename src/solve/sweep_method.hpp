#pragma once

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// The paper's plain iteration (Fig. 3) until the termination condition of §4.6 holds. Fills outcome, iterations,
/// residual and history.
void run_sweeps(Net& net, const Model& model, const FairOptions& options, ThreadTeam& team, Context& context,
                ProgressReporter& progress, FairReport& report);

}  // namespace vspring
