#include <chrono>
#include <utility>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "fairness/measure.hpp"
#include "solve/account.hpp"
#include "solve/equilibrium_method.hpp"
#include "solve/fair_boundary.hpp"
#include "solve/multigrid_method.hpp"
#include "solve/surface_hierarchy.hpp"
#include "solve/sweep_method.hpp"
#include "vspring/fair.hpp"

namespace vspring {

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options, Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  options.validate();
  if (options.fair_boundary) {
    FairResult result = fair_boundary_first(mesh, constraints, options, context);
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }
  FairResult result;
  FairReport& report = result.report;
  report.warnings = check_constraints(mesh, constraints);
  report.method = options.method.value_or(Method::sweep);

  ProgressReporter progress(context);
  progress.report("preparing", 0);
  ThreadTeam team(context.thread_count());
  report.threads = team.size();
  Net net = gather_net(mesh, constraints);
  count_nodes(net, constraints, report);
  report.faces = mesh.face_count();
  report.before = measure(mesh, &constraints, team);

  const auto model = surface_model(options.pseudo_normals);
  if (report.method == Method::sweep) {
    distribute(net, *model, options.distribution, team);
    run_sweeps(net, *model, options, team, context, progress, report);
  } else {
    SurfaceHierarchy hierarchy(surface_levels(std::move(net), *model, options.distribution, team), team);
    const auto run = report.method == Method::multigrid ? run_multigrid : run_equilibrium;
    run(hierarchy, *model, options, team, context, progress, report);
    net = std::move(hierarchy).take();
  }

  result.positions = scatter_positions(net, mesh.positions(), constraints, options.strength);
  measure_moves(net, mesh.positions(), result.positions, report);
  PolygonMesh faired = mesh;
  faired.set_positions(result.positions);
  report.after = measure(faired, &constraints, team);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options) {
  Context context;
  return fair(mesh, constraints, options, context);
}

}  // namespace vspring
