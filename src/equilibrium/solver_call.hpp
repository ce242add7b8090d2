#pragma once

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// What every solver needs: threads, context, progress, and the report that it fills.
struct SolverCall {
  ThreadTeam& team;
  Context& context;
  ProgressReporter& progress;
  FairReport& report;
};

}  // namespace vspring
