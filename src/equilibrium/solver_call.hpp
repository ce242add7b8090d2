#pragma once

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// What a solver works by, and where it says what it did.
struct SolverCall {
  const FairOptions& options;
  ThreadTeam& team;
  Context& context;
  ProgressReporter& progress;
  FairReport& report;
};

}  // namespace vspring
