// Surfaces of every kind of face and of disorder to their equilibrium, those that do badly among them; with a folder
// as argument, also regions of every mesh there, 6 % and 12 % of the diagonal about four nodes. Prints a table,
// which docs/zoo.md sums up: lengths as shares of the diagonal of what moves; the true error is the distance from
// a run to 1e-12.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "regions.hpp"
#include "support/fairness_of.hpp"
#include "support/specimens.hpp"

namespace {

using namespace vspring;
using namespace bench;
using namespace support;

constexpr int cells = 48;
// A distance, as a share of the diagonal.
constexpr double another_equilibrium = 1e-4;

struct Tally {
  int converged = 0;
  int all = 0;
};

struct Summary {
  Tally shapes;
  Tally regions;
  double least_ratio = 1;
  std::string at_least;
  double greatest_ratio = 1;
  std::string at_greatest;
};

/// The error of a result by a run to 1e-12; none where that run does not get a hundred times as near.
std::optional<double> error_by(const PolygonMesh& start, const Specimen& specimen, const FairResult& result) {
  const double expected = result.report.expected_error.value_or(0);
  const FairOptions options = {.method = EquilibriumMethod{.tolerance = 1e-12},
                               .fair_by = result.report.fair_by,
                               .distribution = specimen.distribution};
  const FairResult truth = fair(start, specimen.constraints, options);
  if (truth.report.outcome != Outcome::converged && !(truth.report.expected_error.value_or(1) < 1e-2 * expected))
    return std::nullopt;
  return greatest_distance(result.positions, truth.positions) / diagonal(specimen.start, specimen.constraints);
}

/// By a run from the same start; where that ends at another equilibrium, by one from the result.
std::optional<double> true_error(const Specimen& specimen, const FairResult& result) {
  const std::optional<double> error = error_by(specimen.start, specimen, result);
  if (error && *error < another_equilibrium) return error;
  return error_by(with_positions(specimen.start, result.positions), specimen, result);
}

void run(const Specimen& specimen, Tally& tally, Summary& summary) {
  FairOptions options;
  options.distribution = specimen.distribution;
  const FairResult result = fair(specimen.start, specimen.constraints, options);
  const FairReport& report = result.report;
  const bool converged = report.outcome == Outcome::converged;
  ++tally.all;
  if (converged) ++tally.converged;
  const double expected = report.expected_error.value_or(0);
  std::optional<double> error;
  if (converged) error = true_error(specimen, result);
  const double ratio = error && expected > 0 ? *error / expected : 0;
  if (ratio > summary.greatest_ratio) {
    summary.greatest_ratio = ratio;
    summary.at_greatest = specimen.name;
  }
  if (ratio > 0 && ratio < summary.least_ratio) {
    summary.least_ratio = ratio;
    summary.at_least = specimen.name;
  }
  const auto [before, after] = fairness_of(specimen.start, specimen.constraints, result.positions);
  std::string from_closed_form;
  if (specimen.distance) {
    double greatest = 0;
    for (const Vector3& p : result.positions) greatest = std::max(greatest, specimen.distance(p));
    from_closed_form = fmt::format("{:.1e}", greatest / diagonal(specimen.start, specimen.constraints));
  }
  fmt::print("| {} | {} | {} | {} | {} | {} | {:.3f} | {:.1e} | {} | {} | {} | {:.3g} → {:.3g} |\n", specimen.name,
             report.moving_nodes, name(report.outcome), name(report.springs), report.iterations,
             report.levels.back().iterations, report.seconds, expected, error ? fmt::format("{:.1e}", *error) : "?",
             error ? fmt::format("{:.2f}", ratio) : "", from_closed_form, before.vspring_energy, after.vspring_energy);
  std::fflush(stdout);
}

void run_regions(const std::filesystem::path& path, Summary& summary) {
  const PolygonMesh mesh = read_surface(path.string()).mesh;
  if (mesh.face_count() == 0) return;  // a curve
  for (const double share : {0.06, 0.12}) {
    for (std::uint64_t draw = 1; draw <= 4; ++draw) {
      const RandomRegion region = random_region(mesh, share * diagonal(mesh), draw);
      const std::string name = fmt::format("{}, {:.0f} %, node {}", path.filename().string(), 100 * share, region.seed);
      try {
        run({name, mesh, hold_all_but(region, mesh)}, summary.regions, summary);
      } catch (const Error& error) {
        fmt::print("| {} | | refused: {} | | | | | | | | |\n", name, error.what());
      }
    }
  }
}

/// Corrections go up and down on the way to its equilibrium.
Specimen many_quads() {
  const PolygonMesh exact =
      generate::cylinder_patch({.columns = 96, .rows = 96, .faces = generate::Faces::quads, .jitter = 0.2}, 1, 120, 2);
  return {"cylinder of many quads, noisy, normals estimated", generate::add_noise(exact, 0.02, 3),
          clamped_boundary(exact), Distribution::even,
          [](const Vector3& p) { return std::abs(p.head<2>().norm() - 1); }};
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print(
      "| case | moving nodes | outcome | springs | iterations, all levels | on the finest | seconds | expected error | "
      "true error | true / expected | from the closed form | V-Spring energy "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  Summary summary;
  for (const Specimen& specimen : specimens(cells)) run(specimen, summary.shapes, summary);
  run(many_quads(), summary.shapes, summary);
  if (argc > 1) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
      const std::string extension = entry.path().extension();
      if (extension == ".ply" || extension == ".off" || extension == ".stl" || extension == ".obj")
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths) {
      try {
        run_regions(path, summary);
      } catch (const Error& error) {
        fmt::print("| {} | | refused: {} | | | | | | | | |\n", path.filename().string(), error.what());
      }
    }
  }
  fmt::print("\n{} of {} shapes and {} of {} regions converge; true / expected is {:.2f} ({}) to {:.2f} ({}).\n",
             summary.shapes.converged, summary.shapes.all, summary.regions.converged, summary.regions.all,
             summary.least_ratio, summary.at_least, summary.greatest_ratio, summary.at_greatest);
  return 0;
}
