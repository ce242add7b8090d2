// vspring and other programs on the same meshes: time and memory of the call alone, accuracy where the shape is known.
// Caps of 60° that start flat, with and without noise, rim and its tangent planes held; and the annulus of the paper's
// table. Every run is a process of its own. `bench_peers 1000000` goes on to that many nodes;
// a second argument is the only size of the caps, without the annulus.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "driver.hpp"
#include "flat_cap.hpp"

namespace {

using namespace vspring;
using namespace bench;

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

struct Case {
  std::string name;
  PolygonMesh start;
  bool sphere;  ///< the shape to come is the unit sphere
};

Case cap_case(Index nodes, double noise) {
  PolygonMesh exact = exact_cap(nodes);
  const std::vector<std::uint8_t> held = two_outer_rings(exact);
  PolygonMesh start = flat_cap(exact, noise);
  std::vector<Vector3> positions = start.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (held[i] != 0) positions[i] = exact.positions()[i];
  }
  start.set_positions(std::move(positions));
  return {noise > 0 ? fmt::format("cap, noise {}", noise) : "cap", std::move(start), true};
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "vspring-peers-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Runs a driver; nothing where it failed.
std::optional<Cost> run(const fs::path& driver, const std::string& mesh, const std::string& result, int threads,
                        const std::string& variant) {
  // CHOLMOD's own loops ask OpenMP for four threads whatever it would offer; only its limit keeps them to fewer.
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "VTK_SMP_MAX_THREADS"})
    setenv(variable, std::to_string(threads).c_str(), 1);
  // Threads of OpenMP that wait in a loop for others multiply CHOLMOD's time on a machine with other work.
  setenv("OMP_WAIT_POLICY", "passive", 1);
  const std::string command = fmt::format("'{}' '{}' '{}' {} '{}'", driver.string(), mesh, result, threads, variant);
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error("cannot run " + command);
  Cost cost;
  const int read = fscanf(output, "%lf %lf", &cost.seconds, &cost.mebibytes);
  const bool succeeded = pclose(output) == 0 && read == 2;
  return succeeded ? std::optional(cost) : std::nullopt;
}

std::optional<Cost> best_run(const fs::path& driver, const std::string& mesh, const std::string& result, int threads,
                             const std::string& variant, int times) {
  std::optional<Cost> best;
  for (int k = 0; k < times; ++k) {
    const std::optional<Cost> cost = run(driver, mesh, result, threads, variant);
    if (cost && (!best || cost->seconds < best->seconds)) best = cost;
  }
  return best;
}

double diagonal(const PolygonMesh& mesh) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : mesh.positions()) box.extend(position);
  return box.diagonal().norm();
}

void compare(const Case& input, const fs::path& drivers) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("start.ply");
  const std::string result = folder.file("result.ply");
  write_surface(mesh, input.start);
  const Index nodes = input.start.node_count();
  std::map<int, double> vspring_seconds;  // by threads
  PolygonMesh equilibrium;
  for (const Program& program : programs()) {
    if (nodes > program.most_nodes) continue;
    const bool ours = program.driver == "vspring";
    const std::string variant = ours && input.sphere ? "sphere" : program.variant;
    for (const int threads : program.threads) {
      const std::optional<Cost> cost =
          best_run(drivers / ("peer_" + program.driver), mesh, result, threads, variant, nodes > few_nodes ? 1 : 3);
      if (!cost) {
        fmt::print("| {} | {} | {} | {} | failed | | | |\n", input.name, nodes, program.name, threads);
        continue;
      }
      const PolygonMesh faired = read_surface(result).mesh;
      if (ours) {
        vspring_seconds[threads] = cost->seconds;
        equilibrium = faired;
      }
      std::string error;
      if (input.sphere) {
        error = fmt::format("{:.1e}", distance_from_sphere(faired.positions()));
      } else if (!ours && equilibrium.node_count() > 0) {
        error = fmt::format("{:.1e}", distance(faired.positions(), equilibrium).greatest / diagonal(input.start));
      }
      fmt::print("| {} | {} | {} | {} | {:.3f} | {:.0f} | {} | {} |\n", input.name, nodes, program.name, threads,
                 cost->seconds, cost->mebibytes, error,
                 ours ? "1" : fmt::format("{:.2f}", cost->seconds / vspring_seconds[threads]));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const fs::path drivers = fs::path(argv[0]).parent_path();
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
