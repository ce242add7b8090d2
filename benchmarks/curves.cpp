// Curves to their equilibrium: time and accuracy against the number of nodes, and where double precision ends. A
// circular arc, which the equations reproduce exactly, shows the solver's own error; a clothoid with an inflection
// shows that of the discretisation too, which falls with the square of the spacing until rounding takes over.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "support/clothoid.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;

struct Case {
  PolygonCurve curve;
  Constraints constraints;
};

/// From (0, 0) to (1, 0) with these tangents, starting from half a wave with its nodes out of place by up to
/// `greatest_noise`.
Case disturbed(Index nodes, double angle_start, double angle_end, double greatest_noise = 0.05) {
  Random random(7);
  const auto noise = [&] { return greatest_noise * (2 * random.uniform() - 1); };
  std::vector<Vector3> positions(static_cast<std::size_t>(nodes), Vector3::Zero());
  positions.back().x() = 1;
  for (std::size_t k = 1; k + 1 < positions.size(); ++k) {
    const double u = static_cast<double>(k) / static_cast<double>(nodes - 1);
    positions[k] = Vector3(u + noise(), std::sin(3 * u) * 0.3 + noise(), 0);
  }
  Case made{PolygonCurve(std::move(positions)), Constraints(nodes)};
  fix_boundary_positions(made.constraints, made.curve);
  made.constraints.fix_tangent(0, Vector3(std::cos(angle_start), std::sin(angle_start), 0));
  made.constraints.fix_tangent(nodes - 1, Vector3(std::cos(angle_end), std::sin(angle_end), 0));
  return made;
}

/// Largest distance of a node from the clothoid.
double distance_from(const reference::Clothoid& clothoid, const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    double s = clothoid.length * static_cast<double>(k) / static_cast<double>(positions.size() - 1);
    const Eigen::Vector2d node = positions[k].head<2>();
    Eigen::Vector2d away = node - clothoid.at(s);
    for (int step = 0; step < 2; ++step) {
      const double angle = clothoid.angle_at(s);
      s += away.dot(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      away = node - clothoid.at(s);
    }
    greatest = std::max(greatest, away.norm());
  }
  return greatest;
}

struct Timed {
  FairResult result;
  double solver_seconds = 0;
};

Timed best_of(int times, const Case& task, double tolerance, int threads) {
  FairOptions options;
  options.method = EquilibriumMethod{.tolerance = tolerance};
  Context context;
  context.threads = threads;
  Timed best;
  for (int k = 0; k < times; ++k) {
    Timed run{fair(task.curve, task.constraints, options, context)};
    for (const LevelReport& level : run.result.report.levels) run.solver_seconds += level.seconds;
    if (k == 0 || run.result.report.seconds < best.result.report.seconds) best = std::move(run);
  }
  return best;
}

void print_times(const std::vector<Index>& sizes) {
  fmt::print(
      "Arc of 115°, noise of a twentieth of the chord, tolerance 1e-5; errors relative to the chord.\n\n"
      "| nodes | whole call, 1 thread, ms | 2 threads, ms | solver alone, ms | ns a node | iterations, all levels | on "
      "the "
      "finest | error |\n|---|---|---|---|---|---|---|---|\n");
  const reference::Clothoid arc = reference::hermite_clothoid({0, 0}, 1, {1, 0}, -1);
  for (const Index nodes : sizes) {
    const Case task = disturbed(nodes, 1, -1);
    const int times = nodes > 100'000 ? 3 : 7;
    const Timed alone = best_of(times, task, 1e-5, 1);
    const Timed both = best_of(times, task, 1e-5, 2);
    const FairReport& report = both.result.report;
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {} | {} | {:.1e} |\n", nodes,
               1e3 * alone.result.report.seconds, 1e3 * report.seconds, 1e3 * both.solver_seconds,
               1e9 * report.seconds / static_cast<double>(nodes), report.iterations, report.levels.back().iterations,
               distance_from(arc, both.result.positions));
  }
}

void print_accuracy(const std::vector<Index>& sizes) {
  fmt::print(
      "\nThe same arc, and a clothoid from 60° to 100° with an inflection, as exactly as they can be had (tolerance "
      "1e-14).\n\n"
      "| nodes | arc: error | clothoid: error | × n² | outcome |\n|---|---|---|---|---|\n");
  const reference::Clothoid arc = reference::hermite_clothoid({0, 0}, 1, {1, 0}, -1);
  const double start = 60 * M_PI / 180;
  const double end = 100 * M_PI / 180;
  const reference::Clothoid spiral = reference::hermite_clothoid({0, 0}, start, {1, 0}, end);
  for (const Index nodes : sizes) {
    const double square = static_cast<double>(nodes) * static_cast<double>(nodes);
    const Timed round = best_of(1, disturbed(nodes, 1, -1), 1e-14, 2);
    const Timed spiralling = best_of(1, disturbed(nodes, start, end), 1e-14, 2);
    const double arc_error = distance_from(arc, round.result.positions);
    const double error = distance_from(spiral, spiralling.result.positions);
    fmt::print("| {} | {:.1e} | {:.2e} | {:.3f} | {} |\n", nodes, arc_error, error, error * square,
               name(spiralling.result.report.outcome));
  }
}

void print_sweeps() {
  fmt::print(
      "\nThe plain iteration on the same arc, from a start without noise, until its error is below 1e-3, and what its "
      "own test (e = 0.001) leaves.\n\n"
      "| nodes | sweeps to 1e-3 | sweeps to e = 0.001 | error then | iterations of the equilibrium solver to 1e-5 "
      "|\n|---|---|---|---|---|\n");
  const reference::Clothoid arc = reference::hermite_clothoid({0, 0}, 1, {1, 0}, -1);
  for (const Index nodes : {Index{11}, Index{21}, Index{41}}) {
    const Case task = disturbed(nodes, 1, -1, 0);
    const FairResult plain = fair(task.curve, task.constraints, {.method = SweepMethod{.max_iterations = 10'000'000}});
    // Doubling the sweeps until the error is small enough, then halving the gap.
    const auto error_after = [&](int sweeps) {
      const FairOptions limited = {.method = SweepMethod{.step_tolerance = 1e-300, .max_iterations = sweeps}};
      return distance_from(arc, fair(task.curve, task.constraints, limited).positions);
    };
    int high = 16;
    while (error_after(high) > 1e-3) high *= 2;
    int low = high / 2;
    while (high - low > high / 50) {
      const int middle = low + (high - low) / 2;
      (error_after(middle) > 1e-3 ? low : high) = middle;
    }
    fmt::print("| {} | {} | {} | {:.3f} | {} |\n", nodes, high, plain.report.iterations,
               distance_from(arc, plain.positions), best_of(1, task, 1e-5, 2).result.report.iterations);
  }
}

}  // namespace

int main() {
  const std::vector<Index> sizes = {100, 300, 1'000, 3'000, 10'000, 30'000, 100'000, 300'000, 1'000'000};
  try {
    print_times(sizes);
    print_accuracy(sizes);
    print_sweeps();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
