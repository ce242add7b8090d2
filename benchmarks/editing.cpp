// What editing costs: a shape that follows one node that is dragged, against fairing it anew; and a region of a large
// mesh, against a mesh of the region alone. `bench_editing 1000000` is the size of the large mesh.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "flat_cap.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;
using namespace support;

constexpr int steps = 20;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// For pictures, as in the editor.
constexpr double picture_tolerance = 2e-4;

/// Of 20 steps there and back, of a share of the diagonal each, and 20 more for pictures.
void drag(const char* what, const PolygonMesh& mesh, Constraints constraints, Index node, double share, int threads) {
  FairingSession session(mesh, {}, threads);
  Context context;
  context.threads = threads;
  const FairResult first = session.fair(constraints);
  if (!constraints.position_fixed(node)) {
    constraints.fix_position(node, first.positions[static_cast<std::size_t>(node)]);
    (void)session.fair(constraints);
  }
  const double size = diagonal(mesh);
  std::vector<double> seconds[2];
  int iterations[2] = {0, 0};
  for (int k = 0; k < 2 * steps; ++k) {
    const int pictures = k / steps;
    const double step = (k % 10 < 5 ? share : -share) * size;
    constraints.fix_position(node, constraints.position(node) + Vector3(0, 0, step));
    const FairReport report =
        (pictures ? session.update(constraints, picture_tolerance, context) : session.fair(constraints)).report;
    seconds[pictures].push_back(report.seconds);
    iterations[pictures] += report.iterations;
  }
  std::vector<double> anew;
  anew.reserve(5);
  for (int k = 0; k < 5; ++k) anew.push_back(fair(mesh, constraints, {}, context).report.seconds);
  fmt::print("| {} | {:.1f} % | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", what, 100 * share, threads,
             1000 * median(seconds[1]), 1.0 * iterations[1] / steps, 1000 * median(seconds[0]),
             1.0 * iterations[0] / steps, 1000 * median(anew));
}

struct Timed {
  double seconds;
  Index moving;
};

Timed time_region(const PolygonMesh& mesh, double half_angle, int threads) {
  Constraints constraints(mesh.node_count());
  std::vector<Index> region;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (std::acos(std::clamp(mesh.position(i).normalized().z(), -1.0, 1.0)) < half_angle) region.push_back(i);
  }
  restrict_to_region(constraints, mesh, region);
  Context context;
  context.threads = threads;
  std::vector<double> seconds;
  FairReport report;
  for (int k = 0; k < 3; ++k) {
    report = fair(mesh, constraints, {}, context).report;
    seconds.push_back(report.seconds);
  }
  return {median(seconds), report.moving_nodes};
}

}  // namespace

int main(int argc, char** argv) {
  const auto nodes = static_cast<Index>(argc > 1 ? std::atoi(argv[1]) : 250'000);
  const PolygonMesh annulus = generate::annulus({.nodes = 14962, .boundary_nodes = 608});
  const Constraints clamped = clamped_boundary(annulus);
  Index rim = 0;
  while (!clamped.position_fixed(rim)) ++rim;
  Index inside = 0;
  for (Index i = 0; i < annulus.node_count(); ++i) {
    const Vector3 middle(0.65, 0, 0.3);
    if ((annulus.position(i) - middle).norm() < (annulus.position(inside) - middle).norm()) inside = i;
  }
  fmt::print(
      "| dragged, of 14,962 nodes | step, of the diagonal | threads | for a picture, ms | iterations | to 1e-5, ms | "
      "iterations | anew, ms |\n|---|---|---|---|---|---|---|---|\n");
  for (const int threads : {1, 2}) {
    drag("a node of the rim", annulus, clamped, rim, 0.001, threads);
    drag("a node inside", annulus, clamped, inside, 0.001, threads);
    drag("a node inside", annulus, clamped, inside, 0.002, threads);
  }

  const PolygonMesh sphere = generate::add_noise(bench::exact_cap(nodes), 1e-4, 3);
  const double share = std::min(1.0, 20'000.0 / nodes);
  // The caps' areas are as their numbers of nodes.
  const double half_angle = std::acos(1 - share * (1 - std::cos(bench::half_angle * degree)));
  fmt::print(
      "\n| region of | in a mesh of | threads | ms | the region as a mesh of its own, ms |\n|---|---|---|---|---|\n");
  const PolygonMesh alone = generate::add_noise(
      generate::cap({.nodes = 20'400, .half_angle = 1.01 * half_angle / degree, .jitter = 0.3}), 1e-4, 3);
  for (const int threads : {1, 2}) {
    const Timed within = time_region(sphere, half_angle, threads);
    const Timed by_itself = time_region(alone, half_angle, threads);
    fmt::print("| {} | {} | {} | {:.0f} | {:.0f} ({} nodes) |\n", within.moving, nodes, threads, 1000 * within.seconds,
               1000 * by_itself.seconds, by_itself.moving);
  }
  return 0;
}
