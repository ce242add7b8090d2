// vspring and other programs on the same meshes: time and memory of the call alone, accuracy where the shape is known.
// Caps of 60° that start flat, with and without noise, rim and its tangent planes held; and the annulus of the paper's
// table. Every run is a process of its own. `bench_peers 1000000` goes on to that many nodes;
// a second argument is the only size of the caps, without the annulus. `bench_peers figures MESH…` compares how fair
// the results are, `bench_peers holes MESH…` two filled holes of each mesh, `bench_peers regions MESH…` ten regions of
// each; `--out FOLDER` before the meshes keeps all shapes there.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "figures.hpp"
#include "run_driver.hpp"
#include "support/surfaces.hpp"

namespace {

using namespace vspring;
using namespace bench;
using namespace support;

namespace fs = std::filesystem;

constexpr Index few_nodes = 100'000;   ///< up to here the best of three runs counts
constexpr Index many_nodes = 300'000;  ///< beyond, without SparseLU, which needs minutes, and starts without noise

struct Program {
  std::string name;
  std::string driver;
  std::string variant;
  std::vector<int> threads;
  Index most_nodes = 100'000'000;
};

/// vspring first: the others are compared to it.
std::vector<Program> programs() {
  return {{"vspring, equilibrium", "vspring", "", {1, 2}},
          {"CGAL fair, SparseLU (its default)", "cgal", "sparse-lu", {1}, many_nodes},
          {"CGAL fair, CHOLMOD with OpenBLAS", "cgal", "cholmod", {1, 2}},
          {"OpenMesh, Jacobi C1, 100 iterations", "openmesh", "100", {1}},
          {"VTK, windowed sinc, 100 iterations, pass band 0.001", "vtk", "100,0.001", {1, 2}}};
}

struct Entry {
  Program program;
  int threads = 1;
  std::string result;  ///< file
  std::optional<Cost> best;
};

/// One for every program and number of threads. Programs take turns, so that other work on the machine meets all.
std::vector<Entry> run_all(const Case& input, const fs::path& drivers, const TemporaryFolder& folder) {
  const Index nodes = input.start.node_count();
  std::vector<Entry> entries;
  for (Program program : programs()) {
    if (nodes > program.most_nodes) continue;
    if (program.driver == "vspring" && input.sphere) program.variant = "sphere";
    for (const int threads : program.threads)
      entries.push_back({program, threads, folder.file(fmt::format("result-{}.ply", entries.size())), {}});
  }
  const std::string mesh = folder.file("start.ply");
  write_surface(mesh, input.start);
  for (int k = 0; k < (nodes > few_nodes ? 1 : 3); ++k) {
    for (Entry& entry : entries) {
      const fs::path driver = drivers / ("peer_" + entry.program.driver);
      const auto cost = run_driver(driver, mesh, entry.result, entry.threads, entry.program.variant);
      if (cost && (!entry.best || cost->seconds < entry.best->seconds)) entry.best = cost;
    }
  }
  return entries;
}

void compare(const Case& input, const fs::path& drivers) {
  const TemporaryFolder folder;
  const double size = diagonal(input.start);
  std::map<int, double> vspring_seconds;  // by threads
  std::optional<PolygonMesh> equilibrium;
  for (const Entry& entry : run_all(input, drivers, folder)) {
    fmt::print("| {} | {} | {} | {} | ", input.name, input.start.node_count(), entry.program.name, entry.threads);
    if (!entry.best) {
      fmt::print("failed | | | |\n");
      continue;
    }
    const PolygonMesh faired = read_surface(entry.result).mesh;
    if (entry.program.driver == "vspring") {
      vspring_seconds[entry.threads] = entry.best->seconds;
      equilibrium = faired;
    }
    std::string error;
    if (input.sphere) {
      error = fmt::format("{:.1e}", distance_from_unit_sphere(faired.positions()));
    } else if (equilibrium && entry.program.driver != "vspring") {
      error = fmt::format("{:.1e}", distance(faired.positions(), *equilibrium).greatest / size);
    }
    const auto ours = vspring_seconds.find(entry.threads);
    fmt::print("{:.3f} | {:.0f} | {} | {} |\n", entry.best->seconds, entry.best->mebibytes, error,
               ours == vspring_seconds.end() ? "" : fmt::format("{:.2f}", entry.best->seconds / ours->second));
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const fs::path drivers = fs::path(argv[0]).parent_path();
    if (argc > 1 && std::string(argv[1]) == "figures") {
      compare_figures(drivers, {argv + 2, argv + argc});
      return 0;
    }
    if (argc > 1 && std::string(argv[1]) == "holes") {
      compare_holes(drivers, {argv + 2, argv + argc});
      return 0;
    }
    if (argc > 1 && std::string(argv[1]) == "regions") {
      const bool keeps_shapes = argc > 3 && std::string(argv[2]) == "--out";
      compare_regions(drivers, {argv + (keeps_shapes ? 4 : 2), argv + argc}, keeps_shapes ? argv[3] : "");
      return 0;
    }
    const auto last = static_cast<Index>(argc > 1 ? std::atoi(argv[1]) : 65'000);
    std::vector<Index> sizes;
    for (const Index nodes : {16'000, 65'000, 250'000, 1'000'000}) {
      if (nodes <= last) sizes.push_back(nodes);
    }
    if (argc > 2) sizes = {static_cast<Index>(std::atoi(argv[2]))};
    fmt::print(
        "| start | nodes | program | threads | seconds | MiB | error | time, of vspring's |\n"
        "|---|---|---|---|---|---|---|---|\n");
    if (argc <= 2) compare({"annulus", generate::annulus({.nodes = 14962, .boundary_nodes = 608}), false}, drivers);
    for (const Index nodes : sizes) {
      compare(cap_case(nodes, 0.02), drivers);
      if (nodes <= many_nodes) compare(cap_case(nodes, 0), drivers);
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "peers: {}\n", error.what());
    return 1;
  }
}
