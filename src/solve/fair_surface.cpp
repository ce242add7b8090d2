#include <chrono>
#include <variant>

#include "constraints/immovable_nodes_fixed.hpp"
#include "constraints/slivers.hpp"
#include "solve/curvature_join.hpp"
#include "solve/fair_boundary.hpp"
#include "solve/sharp_sides.hpp"
#include "solve/surface_fairing.hpp"
#include "vspring/fair.hpp"

namespace vspring {

FairResult fair(const PolygonMesh& given, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  options.validate();
  if (!options.sharp_edges.empty()) {
    FairResult result = fair_sharp_sides(given, constraints, options, context);
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }
  // The paper's methods take faces as they are.
  const bool to_equilibrium = std::holds_alternative<EquilibriumMethod>(options.method);
  const PolygonMesh mesh = to_equilibrium ? Slivers(given).left_out(constraints) : given;
  const auto fair_held = [&](const PolygonMesh& sheets, const Constraints& held) {
    if (options.fair_boundary) return fair_boundary_first(sheets, held, options, context);
    FairOptions now = options;
    const bool joins = options.continuity == Continuity::curvature;
    if (joins) now.strength = 1;
    FairResult result = SurfaceFairing(sheets, now, context.thread_count()).fair_once(held, context);
    if (joins) join_with_curvature(sheets, held, options, options.strength, context, result);
    return result;
  };
  ImmovableNodesFixed immovable(mesh);
  FairResult result = immovable.run(constraints, fair_held);
  immovable.join_sheets(constraints, result.positions, result.report);
  result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(mesh, constraints, options, context);
}

}  // namespace vspring
