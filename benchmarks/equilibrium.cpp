// Surfaces to their equilibrium: the time of the whole call against the number of nodes, as a multiple of one plain
// iteration too, the iterations on the finest level, peak memory and the true error. A cap of 60°, which the equations
// reproduce exactly, from a flat start with noise, positions and normals of its rim held. `bench_equilibrium 4000000`
// goes on to that many nodes; a second argument is the only size.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "spring/net.hpp"
#include "sweep/sweep.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;

constexpr double half_angle = 60;
constexpr double noise = 0.02;

struct Case {
  PolygonMesh start;
  Constraints constraints;
};

/// Angles along meridians become radii, so that nothing folds over.
Case flat_cap(Index nodes) {
  PolygonMesh mesh = generate::cap({.nodes = nodes, .half_angle = half_angle, .jitter = 0.3});
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (constraints.position_fixed(i)) constraints.fix_normal(i, mesh.position(i));
  }
  const double rim = half_angle * std::acos(-1) / 180;
  std::vector<Vector3> flat = mesh.positions();
  for (Vector3& p : flat) {
    const double radius = std::hypot(p.x(), p.y());
    const double scale = radius > 0 ? std::atan2(radius, p.z()) / rim * std::sin(rim) / radius : 0;
    p = Vector3(scale * p.x(), scale * p.y(), std::cos(rim));
  }
  mesh.set_positions(std::move(flat));
  return {generate::add_noise(std::move(mesh), noise, 5), std::move(constraints)};
}

double distance_from_sphere(const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& p : positions) greatest = std::max(greatest, std::abs(p.norm() - 1));
  return greatest;
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

/// Peak memory is counted from here on (Linux).
void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

double peak_memory_mebibytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word != "VmHWM:") continue;
    double kibibytes = 0;
    status >> kibibytes;
    return kibibytes / 1024;
  }
  return 0;
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
    const Case input = flat_cap(nodes);
    for (const int threads : {1, 2}) {
      const double iteration = iteration_seconds(input, threads);
      FairOptions options;
      options.method = Method::equilibrium;
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
        error = distance_from_sphere(result.positions);
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
