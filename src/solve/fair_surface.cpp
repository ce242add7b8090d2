#include <chrono>
#include <variant>

#include "constraints/immovable_nodes_fixed.hpp"
#include "constraints/slivers.hpp"
#include "solve/fair_boundary.hpp"
#include "solve/surface_fairing.hpp"
#include "vspring/fair.hpp"

namespace vspring {

FairResult fair(const PolygonMesh& given, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  options.validate();
  // The paper's methods take faces as they are.
  const bool to_equilibrium = std::holds_alternative<EquilibriumMethod>(options.method);
  const PolygonMesh mesh = to_equilibrium ? Slivers(given).left_out(constraints) : given;
  const auto fair_held = [&](const Constraints& held) {
    return options.fair_boundary ? fair_boundary_first(mesh, held, options, context)
                                 : SurfaceFairing(mesh, options, context.thread_count()).fair_once(held, context);
  };
  FairResult result = ImmovableNodesFixed(mesh).run(
      constraints, fair_held, [](FairResult & faired) -> auto& { return faired.report.warnings; });
  result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(mesh, constraints, options, context);
}

}  // namespace vspring
