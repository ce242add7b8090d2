// Scattered points on a cap of a sphere with noise, ten for every node: what finding their nodes takes, a change of
// ties, and a whole fit by the default solver, which starts from the cap pressed flat; and memory beside that of
// fairing alone, in bytes a point.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "flat_cap.hpp"
#include "memory.hpp"
#include "points/nearest_nodes.hpp"
#include "points/point_ties.hpp"
#include "seconds.hpp"
#include "support/fits.hpp"

namespace {

using namespace vspring;
using bench::seconds;

constexpr int points_a_node = 10;
constexpr int updates = 5;
constexpr double smoothing_length = 0.05;

/// Mebibytes at the peak of a call above what there was before.
template <typename Call>
double memory_of(const Call& call) {
  bench::forget_peak_memory();
  const double before = bench::resident_mebibytes();
  call();
  return bench::peak_memory_mebibytes() - before;
}

void measure_points(int count, int threads) {
  const PolygonMesh cap = bench::exact_cap(count / points_a_node);
  const PolygonMesh flat = bench::flat_cap(cap, 0);
  const Constraints held = support::held_boundary(flat, support::radial);
  const ScatteredPoints points = support::on_the_sphere(count, 0.005);
  ThreadTeam team(threads);

  std::vector<Index> nearest;
  const std::vector<std::uint8_t> usable(static_cast<std::size_t>(flat.node_count()), 1);
  const double search = seconds([&] { nearest = nearest_nodes(points.positions, flat.positions(), usable, team); });
  double update = 0;
  {
    Net net = gather_net(flat, held);
    PointTies ties(net, points.positions, std::vector<double>(points.positions.size(), 1), nearest);
    // From the flat disc to the cap, in steps.
    const std::vector<Vector3> start = net.positions;
    for (int k = 1; k <= updates; ++k) {
      for (std::size_t i = 0; i < net.moving; ++i) {
        const Vector3 end = net.frame.to_local(cap.position(net.node[i]));
        net.positions[i] = start[i] + (1.0 * k / updates) * (end - start[i]);
      }
      update += seconds([&] { (void)ties.renew(team); }) / updates;
    }
  }

  Context context;
  context.threads = threads;
  const FitOptions options{.criterion = SmoothingLength{smoothing_length}};
  const double fairing = memory_of([&] { (void)fair(flat, held, options.fair, context); });
  FitReport report;
  const double fitting = memory_of([&] { report = fit(flat, held, points, options, context).report; });
  fmt::print("| {} | {} | {} | {:.2f} | {:.1f} | {:.0f} | {:.2f} | {} | {:.0f} |\n", count, flat.node_count(), threads,
             search, 1e3 * update, 1e9 * update / count, report.fair.seconds, report.fair.iterations,
             (fitting - fairing) * 1024 * 1024 / count);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
  fmt::print(
      "| points | nodes | threads | finding their nodes, s | a change of ties, ms | of a point, ns | the fit, s | "
      "iterations, all levels | bytes a point |\n|---|---|---|---|---|---|---|---|---|\n");
  for (int count = 10'000; count <= largest; count *= 10) {
    for (const int threads : {1, 2}) measure_points(count, threads);
  }
  return 0;
}
