// Fairs regions of meshes that users have: for each mesh, spheres of 6 % and 12 % of the diagonal about three nodes,
// the rest fixed. Prints a table by region; docs/real-meshes.md sums it up. With a folder as first argument
// before the meshes
// (--out FOLDER) leaves the meshes before and after there, with the --view of each for --picture.

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "regions.hpp"
#include "support/fairness_of.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;
using namespace bench;

void add_view(std::ofstream& views, const std::string& name, const PolygonMesh& mesh, const RandomRegion& region) {
  const Index nodes[] = {region.seed};
  Vector3 normal = estimate_normals(mesh, nodes).front();
  if (normal.isZero(0)) normal = Vector3(0, 0, 1);
  const Vector3 up = std::abs(normal.y()) < 0.9 ? Vector3(0, 1, 0) : Vector3(0, 0, 1);
  const Vector3 side = normal.cross(up).normalized();
  const Vector3 towards = 4.5 * normal + 2.5 * side + 1.5 * up;
  views << fmt::format("{} --view={},{},{},{},{},{}\n", name, towards.x(), towards.y(), towards.z(), up.x(), up.y(),
                       up.z());
}

void run(const std::string& path, const std::filesystem::path& out, std::ofstream& views) {
  const SurfaceFile file = read_surface(path);
  const PolygonMesh& mesh = file.mesh;
  const double size = support::diagonal(mesh);
  const std::string stem = std::filesystem::path(path).stem();
  for (const double share : {0.06, 0.12}) {
    for (std::uint64_t run = 0; run < 3; ++run) {
      const RandomRegion region = random_region(mesh, share * size, run + 1);
      const std::string row = fmt::format("| {} | {:.0f} % | {} |", std::filesystem::path(path).filename().string(),
                                          100 * share, region.seed);
      try {
        const Constraints held = hold_all_but(region, mesh);
        const FairResult result = fair(mesh, held);
        const FairReport& report = result.report;
        const auto [before, after] = support::fairness_of(mesh, held, result.positions);
        fmt::print("{} {} | {} | {} | {} | {:.3f} | {:.3g} → {:.3g} | {:.0f} → {:.0f} | {:.1f} → {:.1f} | {:.2f} % |\n",
                   row, report.moving_nodes, name(report.outcome), name(report.springs), report.iterations,
                   report.seconds, before.vspring_energy, after.vspring_energy, before.greatest_turn,
                   after.greatest_turn, before.rms_turn, after.rms_turn, 100 * report.greatest_move / size);
        if (!out.empty()) {
          const std::string name = fmt::format("{}-{:.0f}-{}", stem, 100 * share, run + 1);
          (void)write_surface(out / (name + "-before.ply"), mesh);
          PolygonMesh faired = mesh;
          faired.set_positions(result.positions);
          (void)write_surface(out / (name + "-after.ply"), faired);
          add_view(views, name, mesh, region);
        }
      } catch (const Error& error) {
        fmt::print("{} | refused: {} | | | | | | | |\n", row, error.what());
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  int first = 1;
  std::filesystem::path out;
  if (argc > 2 && std::string(argv[1]) == "--out") {
    out = argv[2];
    std::filesystem::create_directories(out);
    first = 3;
  }
  std::ofstream views;
  if (!out.empty()) views.open(out / "views.txt");
  fmt::print(
      "| mesh | radius | seed node | moving nodes | outcome | springs | iterations | seconds | V-Spring energy | "
      "greatest turn, ° | rms turn, ° | largest move, of the diagonal |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int k = first; k < argc; ++k) run(argv[k], out, views);
  return 0;
}
