// Table 1 of the paper: annuli with sharp corners, both boundaries held with their normals, by the paper's V-cycle with
// its parameters; and what the table leaves out, how far each result is from the equilibrium. `bench_table1 1000000`
// goes on to that many nodes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;
using namespace support;

constexpr int papers_levels = 6;
constexpr int most_iterations = 100;

struct Column {
  Index nodes;
  Index boundary_nodes;
  double paper_seconds;  ///< 0 where the paper has no figure
};

FairResult run(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options, int threads,
               int times) {
  Context context;
  context.threads = threads;
  FairResult best;
  for (int k = 0; k < times; ++k) {
    FairResult result = fair(mesh, constraints, options, context);
    if (k == 0 || result.report.seconds < best.report.seconds) best = std::move(result);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Column> columns = {{553, 121, 2.38}, {1610, 202, 13.8}, {3644, 305, 36.4}, {14962, 608, 177.1}};
  if (argc > 1) {
    const auto last = static_cast<Index>(std::atoi(argv[1]));
    for (Index nodes = 60'000; nodes <= last; nodes *= 4)
      columns.push_back({nodes, static_cast<Index>(std::lround(5 * std::sqrt(nodes))), 0});
  }
  for (const PseudoNormals normals : {PseudoNormals::average, PseudoNormals::link}) {
    fmt::print(
        "\n{}, up to 6 levels (from 60,000 nodes on as many as by default), 5 iterations on the way down, e = "
        "0.001:\n\n"
        "| nodes | triangles | levels | paper, s | 1 thread, s | 2 threads, s | ratio to the paper | iterations on the "
        "finest "
        "level | distance from the equilibrium, % of the size |\n|---|---|---|---|---|---|---|---|---|\n",
        normals == PseudoNormals::average ? "Plain average of normals, as in the paper" : "Max's normals");
    double first = 0;
    double last = 0;
    for (const Column& column : columns) {
      const PolygonMesh mesh = generate::annulus({.nodes = column.nodes, .boundary_nodes = column.boundary_nodes});
      const Constraints constraints = clamped_boundary(mesh);
      const int times = column.nodes > 20'000 ? 1 : 3;
      MultigridMethod multigrid;
      if (column.paper_seconds > 0) multigrid.levels = papers_levels;
      const FairOptions by_cycle = {.method = multigrid, .pseudo_normals = normals};
      const FairResult alone = run(mesh, constraints, by_cycle, 1, times);
      const FairResult both = run(mesh, constraints, by_cycle, 2, times);
      // Where it goes nowhere there is nothing to compare with.
      const FairOptions to_equilibrium = {.method = EquilibriumMethod{.max_iterations = most_iterations},
                                          .pseudo_normals = normals,
                                          .springs = Springs::edge,
                                          .distribution = Distribution::even};
      const FairResult equilibrium = run(mesh, constraints, to_equilibrium, 2, 1);
      const double error = greatest_distance(alone.positions, equilibrium.positions) / diagonal(mesh);
      const double seconds = alone.report.seconds;
      if (first == 0) first = seconds;
      last = seconds;
      fmt::print("| {} | {} | {} | {} | {:.4f} | {:.4f} | {} | {} | {} |\n", column.nodes, mesh.face_count(),
                 alone.report.levels.size(), column.paper_seconds > 0 ? fmt::format("{}", column.paper_seconds) : "",
                 seconds, both.report.seconds,
                 column.paper_seconds > 0 ? fmt::format("{:.0f}", column.paper_seconds / seconds) : "",
                 alone.report.levels.back().iterations,
                 equilibrium.report.outcome == Outcome::converged ? fmt::format("{:.2g}", 100 * error) : "?");
      std::fflush(stdout);
    }
    fmt::print("\nGrowth of time: nodes to the power of {:.2f}; the paper's own from 553 to 14,962: {:.2f}\n",
               std::log(last / first) / std::log(static_cast<double>(columns.back().nodes) / columns.front().nodes),
               std::log(177.1 / 2.38) / std::log(14962.0 / 553));
  }
}
