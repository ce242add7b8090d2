#pragma once

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// What any solver works with, and where it says what it did.
struct SolverCall {
  ThreadTeam& team;
  Context& context;
  ProgressReporter& progress;
  FairReport& report;
};

}  // namespace vspring
