// Takes the noise off a scan: no node ends further from where it was measured than a tolerance. The scan is of the
// saddle z = xy, so the program can say how near it comes to the truth. From the project's folder:
// build/examples/04_noise OUT
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>
#include <vspring/vspring.hpp>

using namespace vspring;

double from_truth(const std::vector<Vector3>& nodes) {
  double sum = 0;
  for (const Vector3& p : nodes) sum += std::pow(p.z() - p.x() * p.y(), 2);
  return std::sqrt(sum / static_cast<double>(nodes.size()));
}

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const SurfaceFile scan = read_surface("examples/saddle.ply");
  Constraints constraints(scan.mesh.node_count());
  fix_boundary_positions(constraints, scan.mesh);

  // The points that the surface is drawn to are its own nodes, which keep their places along it.
  FitOptions options;
  options.criterion = Within{0.05};
  options.fair.distribution = Distribution::keep;
  const FitResult result = fit(scan.mesh, constraints, {scan.mesh.positions()}, options);
  write_surface(out + "/04_noise.ply", scan, result.positions);

  std::printf("noise of %.4f; %s: %.4f from the truth, before %.4f; points are at most %.4f away\n",
              estimate_noise(scan.mesh).deviation, name(result.report.fair.outcome), from_truth(result.positions),
              from_truth(scan.mesh.positions()), result.report.after.all.greatest);
  return result.report.fair.usable() ? 0 : 1;
}
