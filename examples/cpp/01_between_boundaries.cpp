// Reads a surface, makes it fair between its boundaries, which keep their places, and writes it.
// From the project's folder: build/examples/01_between_boundaries OUT
#include <cstdio>
#include <string>
#include <vspring/vspring.hpp>

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const auto file = vspring::read_surface("examples/annulus.obj");
  vspring::Constraints constraints(file.mesh.node_count());
  vspring::fix_boundary_positions(constraints, file.mesh);
  const auto [positions, report] = vspring::fair(file.mesh, constraints);
  vspring::write_surface(out + "/01_between_boundaries.obj", file, positions);
  std::printf("%s after %d iterations; nodes moved by up to %.3f\n", name(report.outcome), report.iterations,
              report.greatest_move);
  return report.usable() ? 0 : 1;
}
