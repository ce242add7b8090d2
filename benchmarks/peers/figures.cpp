#include "figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "regions.hpp"
#include "run_driver.hpp"
#include "support/surfaces.hpp"

namespace vspring::bench {

namespace {

/// Raised between its rims by up to 0.2; the rims' slopes stay.
PolygonMesh bulged(PolygonMesh mesh) {
  std::vector<Vector3> positions = mesh.positions();
  double inner = std::numeric_limits<double>::infinity();
  double outer = 0;
  for (const Vector3& position : positions) {
    inner = std::min(inner, position.head<2>().norm());
    outer = std::max(outer, position.head<2>().norm());
  }
  for (Vector3& position : positions) {
    const double wave = std::sin(std::numbers::pi * (position.head<2>().norm() - inner) / (outer - inner));
    position.z() += 0.2 * wave * wave;
  }
  return support::with_positions(std::move(mesh), std::move(positions));
}

struct Program {
  const char* name;
  const char* driver;
  const char* variant;
};

constexpr std::array programs = {Program{"vspring", "vspring", "rings"},
                                 Program{"vspring, by bending", "vspring", "rings,bending"},
                                 Program{"CGAL fair", "cgal", "cholmod"},
                                 Program{"OpenMesh, Jacobi C1, 100 iterations", "openmesh", "100"},
                                 Program{"VTK, windowed sinc, 100 iterations, pass band 0.001", "vtk", "100,0.001"},
                                 Program{"Taubin, λ 0.5, μ −0.53, 100 iterations", "taubin", "100"}};

void print_row(const Case& input, const char* program, const PolygonMesh& mesh) {
  // The rings that are held count too: where a program leaves a crease beside them it is to be seen.
  const SurfaceFigures figures = measure_surface(mesh);
  const std::string error =
      input.sphere ? fmt::format("{:.1e}", support::distance_from_unit_sphere(mesh.positions())) : "";
  fmt::print("| {} | {} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {} | {:.1f} | {:.2f} | {:.1f} | {} |\n", input.name,
             program, figures.vspring_energy, figures.bending_energy, figures.mean_curvature_variation,
             figures.curvature_variation, figures.mean_curvature_extrema, figures.greatest_turn, figures.rms_turn,
             100 * node_distance(input.start.positions(), mesh.positions()).greatest / support::diagonal(input.start),
             error);
}

void compare(const Case& input, const std::filesystem::path& drivers) {
  const TemporaryFolder folder;
  const std::string start = folder.file("start.ply");
  const std::string result = folder.file("result.ply");
  write_surface(start, input.start);
  print_row(input, "start", input.start);
  for (const Program& program : programs) {
    const std::filesystem::path driver = drivers / fmt::format("peer_{}", program.driver);
    std::string variant = program.variant;
    if (program.driver == std::string("vspring") && input.sphere) variant.replace(0, std::strlen("rings"), "sphere");
    if (run_driver(driver, start, result, 1, variant))
      print_row(input, program.name, read_surface(result).mesh);
    else
      fmt::print("| {} | {} | failed | | | | | | | | |\n", input.name, program.name);
    std::fflush(stdout);
  }
}

}  // namespace

void compare_figures(const std::filesystem::path& drivers, const std::vector<std::string>& meshes) {
  fmt::print(
      "| start | program | V-Spring energy | bending energy | mean curvature variation | curvature variation | mean "
      "curvature extrema | greatest turn, ° | rms turn, ° | greatest move, % of the diagonal | distance from the "
      "sphere "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double noise : {0.0, 0.02}) compare(cap_case(4000, noise), drivers);
  compare({"annulus", generate::annulus({.nodes = 3644, .boundary_nodes = 304}), false}, drivers);
  compare({"funnel", bulged(generate::funnel(3644)), false}, drivers);
  for (const std::string& path : meshes) {
    const PolygonMesh mesh = read_surface(path).mesh;
    for (const std::uint64_t run : {0, 1, 2}) {
      const RandomRegion region = random_region(mesh, 0.12 * support::diagonal(mesh), run + 1);
      const std::string name =
          fmt::format("{}, about node {}", std::filesystem::path(path).filename().string(), region.seed);
      compare({name, cut_out(mesh, region.nodes), false}, drivers);
    }
  }
}

}  // namespace vspring::bench
