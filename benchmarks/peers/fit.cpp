// Noise taken off: smooth shapes, and every mesh of the folder that is named, get noise of 0.3 edges. They are fitted
// to their own noisy nodes, which keep their distribution, at several smoothing lengths, boundaries and non-manifold
// spots held, and smoothed by VTK's windowed sinc filter at many settings, of which the best counts. Prints a table:
// root mean square distances between the result and the mesh without noise, of the nodes of
// either from the other, the greater of both, in per cent of the mean edge; † where no equilibrium was found.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "regions.hpp"
#include "smoothers.hpp"

namespace {

using namespace vspring;
using namespace bench;

namespace fs = std::filesystem;

constexpr double noise = 0.3;  ///< radius of the ball that nodes move in, in mean edges
constexpr double smoothing_lengths[] = {0.3, 0.5, 0.7, 1, 1.5, 2, 3};  ///< in mean edges

double mean_edge(const PolygonMesh& mesh) {
  double sum = 0;
  double count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k, ++count)
      sum += (mesh.position(face[k]) - mesh.position(face[(k + 1) % face.size()])).norm();
  }
  return sum / count;
}

/// A distance, in bold where nothing is less.
std::string cell(double value, double least) {
  return value == least ? fmt::format("**{:.2f}**", value) : fmt::format("{:.2f}", value);
}

struct Fitted {
  double distance;
  bool converged;
};

struct Smoothed {
  double distance = std::numeric_limits<double>::infinity();
  std::string settings;
};

template <typename DistanceOf>
Smoothed best_of_vtk(const PolygonMesh& noisy, const fs::path& driver, const DistanceOf& distance_of) {
  Smoothed best;
  for_each_variant(driver, noisy, sinc_variants(),
                   [&](const std::string& variant, const std::vector<Vector3>& positions, const Cost& /*cost*/) {
                     const double reached = distance_of(positions);
                     if (reached < best.distance) best = {reached, variant};
                   });
  return best;
}

void run(const std::string& name, const PolygonMesh& mesh, const fs::path& driver) {
  if (mesh.face_count() == 0) return;  // a curve
  const double edge = mean_edge(mesh);
  const PolygonMesh noisy = generate::add_noise(mesh, noise * edge, 1);
  const auto distance_of = [&](const std::vector<Vector3>& positions) {
    PolygonMesh smooth = mesh;
    smooth.set_positions(positions);
    return 100 * std::max(distance(positions, mesh).rms, distance(mesh.positions(), smooth).rms) / edge;
  };
  Constraints held(mesh.node_count());
  fix_boundary_positions(held, noisy);
  apply_rules(held, noisy, R"({"rules": [{"nodes": "non-manifold", "position": "fixed"}]})");

  const Smoothed vtk = best_of_vtk(noisy, driver, distance_of);
  std::vector<Fitted> fitted;
  for (const double length : smoothing_lengths) {
    FitOptions options;
    options.criterion = SmoothingLength{length * edge};
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(noisy, held, {noisy.positions()}, options);
    fitted.push_back({distance_of(result.positions), result.report.fair.outcome == Outcome::converged});
  }
  double least = vtk.distance;
  for (const Fitted& one : fitted) least = std::min(least, one.distance);
  fmt::print("| {} | {} | {:.2f} | {} | {} |", name, mesh.node_count(), distance_of(noisy.positions()),
             cell(vtk.distance, least), vtk.settings);
  for (const Fitted& one : fitted) fmt::print(" {}{} |", cell(one.distance, least), one.converged ? "" : " †");
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print("| mesh | nodes | noisy | windowed sinc | its iterations, pass band |");
  for (const double length : smoothing_lengths) fmt::print(" λ = {} |", length);
  fmt::print("\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const fs::path driver = fs::path(argv[0]).parent_path() / "peer_vtk";
  const generate::Grid grid = {.columns = 64, .rows = 48, .jitter = 0.2};
  run("sphere patch", generate::sphere_patch(grid, 1, 90), driver);
  run("saddle", generate::saddle(grid, 2), driver);
  run("torus", generate::torus(grid, 1, 0.5), driver);
  if (argc > 1)
    for_each_surface(argv[1], [&](const std::string& name, const PolygonMesh& mesh) { run(name, mesh, driver); });
  return 0;
}
