#include "solve/papers_method.hpp"

#include <memory>
#include <utility>
#include <variant>

#include "base/cancellation.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/from_options.hpp"
#include "equilibrium/multigrid_method.hpp"
#include "equilibrium/sweep_method.hpp"

namespace vspring {

Net run_papers_method(Net net, const Model& model, const ResultCheck& check, const FairOptions& options,
                      const SolverCall& call) {
  const Distribution distribution = distribution_of(net, options);
  if (const auto* const sweep = std::get_if<SweepMethod>(&options.method)) {
    set_laplacian_weights(net, model, distribution, call.team);
    run_sweeps(net, model, *sweep, call);
  } else {
    const std::unique_ptr<Hierarchy> hierarchy = hierarchy_of(std::move(net), model, distribution, call.team);
    run_multigrid(*hierarchy, model, std::get<MultigridMethod>(options.method), call);
    net = std::move(*hierarchy).take();
  }
  // What was found by then is looked at whole where somebody has cancelled.
  const UncancelledScope whole;
  warn_if_worse(check, net, call.report);
  return net;
}

}  // namespace vspring
