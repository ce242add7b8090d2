// How to tell what a call did: progress, ending it before its time, whether its result is usable, and figures of
// fairness before and after. From the project's folder: build/examples/08_report OUT
#include <cstdio>
#include <string>
#include <vspring/vspring.hpp>

using namespace vspring;

/// In one word or two for people; warnings say where and what to do.
void tell(const FairReport& report) {
  std::printf("%s (%s): %d iterations on %zu levels", report.usable() ? "usable" : "not usable", name(report.outcome),
              report.iterations, report.levels.size());
  if (report.expected_error) std::printf(", off by some %.0e of the size", *report.expected_error);
  std::printf("\n");
  for (const Warning& warning : report.warnings) std::printf("  %s: %s\n", name(warning.code), warning.text.c_str());
}

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const SurfaceFile file = read_surface("examples/pipe-blend.obj");
  Constraints constraints(file.mesh.node_count());
  fix_boundary_positions(constraints, file.mesh);
  fix_boundary_normals(constraints, file.mesh);

  // Somebody has enough at once: what comes back is a shape on the way, and says so.
  Context context;
  context.on_progress = [&context](const Progress&) { context.cancel(); };
  const FairReport ended = fair(file.mesh, constraints, {}, context).report;
  tell(ended);

  context.reset();
  context.on_progress = [](const Progress& now) {
    std::printf("%.*s %.0f %%\n", static_cast<int>(now.stage.size()), now.stage.data(), 100 * now.fraction);
  };
  const FairResult result = fair(file.mesh, constraints, {}, context);
  tell(result.report);
  if (ended.usable() || !result.report.usable()) return 1;

  PolygonMesh after = file.mesh;
  after.set_positions(result.positions);
  const auto [first, last] = measure_surfaces(file.mesh, after, nullptr, {});
  std::printf("bending energy %.0f, before %.0f; greatest turn %.1f degrees, before %.1f\n", last.bending_energy,
              first.bending_energy, last.greatest_turn, first.greatest_turn);
  write_surface(out + "/08_report.obj", file, result.positions);
  return 0;
}
