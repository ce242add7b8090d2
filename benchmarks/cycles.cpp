// Time of one multigrid cycle per node, along the normals and across them, on 1 and 2 threads, beside the bytes that it
// has to move and the time that copying as many takes on this machine. `bench_cycles 1000000` is the size.

#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "copy_bandwidth.hpp"
#include "flat_cap.hpp"
#include "levels/levels.hpp"
#include "linear/interpolation.hpp"
#include "precondition/surface_systems.hpp"
#include "seconds.hpp"
#include "support/surfaces.hpp"

namespace {

using namespace vspring;

constexpr std::size_t coarsest_nodes = 3000;
constexpr Accuracy one_cycle = {.share = 1};
// Each coarser level has a quarter of the nodes.
constexpr double all_levels = 4.0 / 3;

/// What a cycle cannot avoid moving if every array is read and written once in each of its passes: four products with
/// the matrix, four steps of the smoother, and the way down and up. matrix: bytes of it that one product reads; value:
/// of one value.
double bytes_of_cycle(double matrix, double value, double interpolation_entries) {
  const double product = matrix + 3 * value;      // values in, residual in and out
  const double step = sizeof(float) + 5 * value;  // diagonal; residual in, step and solution in and out
  const double between = 2 * (8 * interpolation_entries + sizeof(std::uint32_t)) + 4 * value;
  return all_levels * (4 * product + 4 * step + between);
}

struct System {
  const char* name;
  double bytes;
  double seconds;
};

void print(const System& system, std::size_t nodes, int threads, double bandwidth) {
  const double ns = 1e9 * system.seconds / static_cast<double>(nodes);
  const double copying = 1e9 * system.bytes / bandwidth;
  fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.0f} % |\n", system.name, threads, ns, system.bytes, copying,
             100 * copying / ns);
}

}  // namespace

int main(int argc, char** argv) {
  const auto nodes = static_cast<Index>(argc > 1 ? std::atoi(argv[1]) : 1'000'000);
  const PolygonMesh cap = bench::exact_cap(nodes);
  const Constraints constraints = support::held_boundary(cap, support::radial);
  const auto model = surface_model(PseudoNormals::link);
  fmt::print(
      "| system | threads | a cycle, ns a node | bytes moved a node | copying them, ns | share of the bandwidth "
      "|\n|---|---|---|---|---|---|\n");
  for (const int threads : {1, 2}) {
    ThreadTeam team(threads);
    const double bandwidth = bench::copy_bandwidth(team);
    Net gathered = gather_net(cap, constraints, true);
    std::vector<Level> levels = surface_levels(std::move(gathered), *model, Distribution::even, team);
    for (Level& level : levels) update_directions(level.net, *model, team);
    const Net& net = levels.back().net;
    SystemLevels systems = {.net = &net};
    for (std::size_t k = levels.size() - 1; k > 0 && levels[k].net.moving > coarsest_nodes; --k)
      systems.interpolations.push_back(interpolation(levels[k].net, levels[k - 1].net, levels[k - 1].finer, team));
    const double links = static_cast<double>(net.rings.begin(net.moving)) / static_cast<double>(net.moving);
    const double entries = 0.25 + 0.75 * 4;  // a quarter of the nodes are coarse ones, the others have four sources
    const double begin = sizeof(std::uint32_t);

    const auto spreading = spreading_solver(systems, team);
    std::vector<Vector3> across(net.moving, Vector3(1e-3, 2e-3, 3e-3));
    const double graph = sizeof(Link) * links + begin;
    print({"across the normals, three columns", bytes_of_cycle(graph, 3 * sizeof(float), entries),
           bench::best_seconds(5, [&] { spreading->solve(across, one_cycle); })},
          net.moving, threads, bandwidth);

    BendingSystem bending(systems, team);
    bending.build();
    std::vector<double> along(net.moving, 1e-3);
    // Both factors, and what lies between them.
    const double factors = 2 * ((sizeof(Link) + sizeof(float)) * links + begin + 3 * sizeof(float));
    print({"along the normals", bytes_of_cycle(factors, sizeof(float), entries),
           bench::best_seconds(5, [&] { bending.solve(along, one_cycle); })},
          net.moving, threads, bandwidth);
  }
  return 0;
}
