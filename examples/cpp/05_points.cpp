// Draws a flat sheet to 4,000 scattered points with noise: what is shorter than some six times the smoothing length
// goes. From the project's folder: build/examples/05_points OUT
#include <cstdio>
#include <string>
#include <vspring/vspring.hpp>

using namespace vspring;

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const SurfaceFile sheet = read_surface("examples/figure-12.obj");
  const ScatteredPoints points = read_points("examples/figure-12.xyz");
  Constraints constraints(sheet.mesh.node_count());
  fix_boundary_positions(constraints, sheet.mesh);

  FitOptions options;
  options.criterion = SmoothingLength{0.1};
  const FitResult result = fit(sheet.mesh, constraints, points, options);
  write_surface(out + "/05_points.obj", sheet, result.positions);

  const FitReport& report = result.report;
  std::printf("%s: %d points, of which %d pull, are %.4f away (root mean square), before %.4f\n",
              name(report.fair.outcome), report.points, report.pulling_points, report.after.all.rms,
              report.before.all.rms);
  return report.fair.usable() ? 0 : 1;
}
