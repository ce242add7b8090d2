#include "solve/fair_boundary.hpp"

#include <memory>
#include <utility>

#include "solve/lines_of_surface.hpp"
#include "vspring/topology.hpp"

namespace vspring {

FairResult fair_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, FairOptions options,
                               Context& context) {
  LinesOfSurface boundary(mesh, constraints, boundary_curve(mesh));
  // What the surface would be refused for comes before the work on its boundary.
  boundary.hold(mesh.positions());
  (void)check_constraints(mesh, boundary.of_surface, {});

  const double strength = std::exchange(options.strength, 1);
  FairOptions curve_options = options;
  curve_options.method = *options.fair_boundary;
  curve_options.continuity = Continuity::tangent;
  options.fair_boundary.reset();
  FairResult curve = fair(boundary.curve, boundary.of_curve, curve_options, context);
  boundary.hold(curve.positions);
  PolygonMesh bounded = mesh;
  bounded.set_positions(std::move(curve.positions));
  FairResult result = fair(bounded, boundary.of_surface, options, context);

  FairReport& report = result.report;
  join(curve.report, report);
  report.boundary = std::make_shared<const FairReport>(std::move(curve.report));
  account_for_moves(mesh, constraints, strength, result.positions, report);
  return result;
}

}  // namespace vspring
