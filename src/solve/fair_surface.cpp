#include <chrono>

#include "solve/fair_boundary.hpp"
#include "solve/surface_fairing.hpp"
#include "vspring/fair.hpp"

namespace vspring {

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options, Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  options.validate();
  if (!options.fair_boundary)
    return SurfaceFairing(mesh, options, context.thread_count()).fair_once(constraints, context);
  FairResult result = fair_boundary_first(mesh, constraints, options, context);
  result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(mesh, constraints, options, context);
}

}  // namespace vspring
