#include "solve/papers_method.hpp"

#include <memory>
#include <utility>

#include "equilibrium/account.hpp"
#include "equilibrium/multigrid_method.hpp"
#include "equilibrium/of_net.hpp"
#include "equilibrium/sweep_method.hpp"

namespace vspring {

Net run_papers_method(Net net, const Model& model, const ResultCheck& check, const SolverCall& call) {
  const Distribution distribution = distribution_of(net, call.options);
  if (call.report.method == Method::sweep) {
    set_laplacian_weights(net, model, distribution, call.team);
    run_sweeps(net, model, call);
  } else {
    const std::unique_ptr<Hierarchy> hierarchy = hierarchy_of(std::move(net), model, distribution, call.team);
    run_multigrid(*hierarchy, model, call);
    net = std::move(*hierarchy).take();
  }
  warn_if_worse(check, net, call.report);
  return net;
}

}  // namespace vspring
