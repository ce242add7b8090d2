// Surfaces to their equilibrium: the time of the whole call against the number of nodes, as a multiple of one plain
// iteration too, the iterations on the finest level, peak memory and the true error. A cap of 60°, which the equations
// reproduce exactly, from a flat start with noise, positions and normals of its rim held. `bench_equilibrium 4000000`
// goes on to that many nodes; a second argument is the only size.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "flat_cap.hpp"
#include "memory.hpp"
#include "spring/net.hpp"
#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "sweep/sweep.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;
using namespace bench;
using namespace support;

constexpr double noise = 0.02;

struct Case {
  PolygonMesh start;
  Constraints constraints;
};

Case flat_start(Index nodes) {
  PolygonMesh cap = exact_cap(nodes);
  Constraints constraints = held_boundary(cap, radial);
  return {flat_cap(std::move(cap), noise), std::move(constraints)};
}

double iteration_seconds(const Case& input, int threads) {
  Net net = gather_net(input.start, input.constraints);
  ThreadTeam team(threads);
  const auto model = surface_model(PseudoNormals::link);
  Sweep sweep(net, *model, team);
  double best = 1e300;
  for (int k = 0; k < 6; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    sweep.iterate();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const auto last = static_cast<Index>(argc > 1 ? std::atoi(argv[1]) : 1'000'000);
  std::vector<Index> sizes;
  for (const Index nodes : {1'000, 4'000, 16'000, 65'000, 250'000, 1'000'000, 4'000'000}) {
    if (nodes <= last) sizes.push_back(nodes);
  }
  if (argc > 2) sizes = {static_cast<Index>(std::atoi(argv[2]))};
  fmt::print(
      "| nodes | threads | seconds | in plain iterations | iterations on the finest level | on all levels | distance "
      "from the sphere | expected error | bytes a node |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const Index nodes : sizes) {
    const Case input = flat_start(nodes);
    for (const int threads : {1, 2}) {
      const double iteration = iteration_seconds(input, threads);
      const FairOptions options = {.method = equilibrium_alone()};
      Context context;
      context.threads = threads;
      FairReport report;
      double error = 0;
      double memory = 0;
      for (int k = 0; k < (nodes > 100'000 ? 1 : 3); ++k) {
        forget_peak_memory();
        FairResult result = fair(input.start, input.constraints, options, context);
        if (k > 0 && result.report.seconds > report.seconds) continue;
        memory = peak_memory_mebibytes();
        error = distance_from_unit_sphere(result.positions);
        report = std::move(result.report);
      }
      fmt::print("| {} | {} | {:.3f} | {:.0f} | {} | {} | {:.1e} | {:.1e} | {:.0f} |{}\n", nodes, threads,
                 report.seconds, report.seconds / iteration, report.levels.back().iterations, report.iterations, error,
                 report.expected_error.value_or(0), memory * 1024 * 1024 / nodes,
                 report.outcome == Outcome::converged ? "" : fmt::format(" {}", name(report.outcome)));
      std::fflush(stdout);
    }
  }
  return 0;
}
