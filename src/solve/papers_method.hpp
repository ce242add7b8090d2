#pragma once

#include "checks/result_check.hpp"
#include "equilibrium/solver_call.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// The shape that a net comes to by the options' method, MultigridMethod or SweepMethod, as it is found: with a warning
/// where that is worse than the start.
Net run_papers_method(Net net, const Model& model, const ResultCheck& check, const FairOptions& options,
                      const SolverCall& call);

}  // namespace vspring
