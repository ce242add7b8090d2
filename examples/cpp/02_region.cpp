// Three pipes that meet in a rough block. Two of their rims keep their tangent planes, too; the end of the third pipe
// is outside of the region that moves, stays to the bit, and is met smoothly. From the project's folder:
// build/examples/02_region OUT
#include <cstdio>
#include <string>
#include <vspring/vspring.hpp>

using namespace vspring;

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const SurfaceFile file = read_surface("examples/pipe-blend.obj");
  Constraints constraints(file.mesh.node_count());
  fix_boundary_positions(constraints, file.mesh);
  fix_boundary_normals(constraints, file.mesh);
  const Region all_but_an_end = {BoxRegion{{-1.2, -2, -2}, {2, 2, 2}}};
  restrict_to_region(constraints, file.mesh, select_region(file.mesh.positions(), all_but_an_end));

  const FairResult result = fair(file.mesh, constraints);
  write_surface(out + "/02_region.obj", file, result.positions);

  PolygonMesh after = file.mesh;
  after.set_positions(result.positions);
  std::printf("%s: %d of %d nodes moved; bending energy %.0f, before %.0f\n", name(result.report.outcome),
              result.report.moving_nodes, result.report.nodes, measure_surface(after).bending_energy,
              measure_surface(file.mesh).bending_energy);
  return result.report.usable() ? 0 : 1;
}
