#pragma once

#include "checks/result_check.hpp"
#include "equilibrium/solver_call.hpp"
#include "spring/model.hpp"

namespace vspring {

/// The shape that a net comes to by the paper's V-cycle over levels (§4.7) or, where its report says Method::sweep, by
/// the plain iteration alone (§4.1), as it is found: with a warning where that is worse than the start.
Net run_papers_method(Net net, const Model& model, const ResultCheck& check, const SolverCall& call);

}  // namespace vspring
