// Drags a node of a sheet upwards, step by step, as an editor does, and prints how another one follows.
// build/examples/06_session OUT
#include <cstdio>
#include <string>
#include <vspring/vspring.hpp>

using namespace vspring;

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const int cells = 24;
  PolygonMesh sheet = generate::plane({.columns = cells, .rows = cells, .faces = generate::Faces::quads}, 2, 2);
  const Index dragged = cells / 2 * (cells + 1) + cells / 2;
  const Index other = dragged + cells / 4;

  Constraints constraints(sheet.node_count());
  fix_boundary_positions(constraints, sheet);
  fix_boundary_normals(constraints, sheet);
  FairingSession session(sheet);
  Context context;
  for (int step = 1; step <= 6; ++step) {
    constraints.fix_position(dragged, sheet.position(dragged) + Vector3(0, 0, 0.1 * step));
    // For a picture: a fifth of a pixel, where the shape is a thousand of them.
    const FairResult now = session.update(constraints, 2e-4, context);
    std::printf("height %.1f: the other node is at %.4f, after %d iterations\n", 0.1 * step,
                now.positions[static_cast<std::size_t>(other)].z(), now.report.iterations);
  }
  // The button is released: to the tolerance, and never worse than the input without a word.
  const FairResult result = session.fair(constraints, context);
  std::printf("%s: the other node is at %.4f\n", name(result.report.outcome),
              result.positions[static_cast<std::size_t>(other)].z());
  sheet.set_positions(result.positions);
  write_surface(out + "/06_session.obj", sheet);
  return result.report.usable() ? 0 : 1;
}
