// Starts that are no curve at all, normals as constraints, and how far the report can be believed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/curves.hpp"
#include "support/fairness_of.hpp"
#include "support/methods.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_hard_test {
namespace {

using namespace support;

/// What is held stays bit for bit, the report tells of this very shape and of what the method did, and nothing worse
/// than the start is called converged.
void expect_sane(const std::vector<Vector3>& start, const Constraints& constraints, bool closed) {
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    for (const FairingMethod& method :
         {FairingMethod(equilibrium_alone()), FairingMethod(SweepMethod{.max_iterations = 100})}) {
      for (const CurveRules& rules : {CurveRules(), CurveRules::paper()}) {
        FairOptions options;
        options.distribution = distribution;
        options.method = method;
        options.curve = rules;
        const FairResult result = fair(PolygonCurve(start, closed), constraints, options);
        const FairReport& report = result.report;
        ASSERT_EQ(result.positions.size(), start.size());
        double greatest_move = 0;
        for (Index i = 0; i < constraints.node_count(); ++i) {
          const Vector3& p = result.positions[static_cast<std::size_t>(i)];
          EXPECT_TRUE(p.allFinite());
          if (constraints.position_fixed(i)) {
            EXPECT_EQ(p, constraints.position(i));
          }
          greatest_move = std::max(greatest_move, (p - start[static_cast<std::size_t>(i)]).stableNorm());
        }
        EXPECT_DOUBLE_EQ(report.greatest_move, greatest_move);
        const Fairness after = measure(PolygonCurve(result.positions, closed), &constraints);
        EXPECT_TRUE(std::isfinite(after.vspring_energy) && std::isfinite(after.greatest_turn));
        EXPECT_NE(report.outcome, Outcome::cancelled);
        const auto* const sweep = std::get_if<SweepMethod>(&method);
        if (sweep) {
          EXPECT_LE(report.iterations, 100);
          if (report.outcome == Outcome::iteration_limit) {
            EXPECT_EQ(report.iterations, 100);
          }
        }
        if (report.outcome != Outcome::converged) continue;
        if (sweep)
          EXPECT_LT(report.residual, sweep->step_tolerance);
        else
          EXPECT_LE(report.expected_error.value_or(1), EquilibriumMethod().tolerance);
        if (measure(PolygonCurve(start, closed), &constraints).greatest_turn >= 90) continue;
        EXPECT_LE(after.greatest_turn, 90.01);
      }
    }
  }
}

/// Held at the ends, with tangents or without; closed at three nodes.
void expect_sane_however_held(const std::vector<Vector3>& start) {
  expect_sane(start, held_ends(start), false);
  expect_sane(start, held_ends(start, {1, 0, 0}, {0, 1, 0.3}), false);
  Constraints three(static_cast<Index>(start.size()));
  for (const Index i : {0, three.node_count() / 3, three.node_count() / 2}) hold(three, start, i);
  expect_sane(start, three, true);
}

TEST(FairCurveHardStarts, RandomPositions) {
  for (const int count : {3, 4, 5, 20, 200}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(fmt::format("{} nodes, seed {}", count, seed));
      Draw draw(seed);
      std::vector<Vector3> nodes;
      nodes.reserve(static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) nodes.push_back(draw.in_cube(1));
      expect_sane_however_held(nodes);
    }
  }
}

TEST(FairCurveHardStarts, FoldedZigzag) {
  for (const int count : {5, 50, 200}) {
    SCOPED_TRACE(count);
    std::vector<Vector3> there_and_back;
    std::vector<Vector3> steep;
    for (int i = 0; i < count; ++i) {
      there_and_back.emplace_back(i % 2, 0, 0);
      steep.emplace_back(0.01 * i, i % 2, 0);
    }
    expect_sane_however_held(there_and_back);
    expect_sane_however_held(steep);
  }
}

TEST(FairCurveHardStarts, AllNodesAtOnePoint) {
  for (const int count : {3, 10, 200}) {
    SCOPED_TRACE(count);
    std::vector<Vector3> nodes(static_cast<std::size_t>(count), Vector3(1, 2, 3));
    expect_sane_however_held(nodes);
    // All but the last.
    nodes.back() = Vector3(2, 2, 3);
    expect_sane_however_held(nodes);
    nodes.assign(static_cast<std::size_t>(count), Vector3::Zero());
    expect_sane_however_held(nodes);
  }
}

TEST(FairCurveHardStarts, CoincidentNeighbours) {
  for (const int count : {6, 40, 200}) {
    SCOPED_TRACE(count);
    std::vector<Vector3> nodes;
    nodes.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) nodes.push_back(heading(0.02 * (i - i % 2)));
    expect_sane_however_held(nodes);
    for (int i = 0; i < count; ++i) nodes[static_cast<std::size_t>(i)] = heading(0.02 * (i - i % 5));
    expect_sane_however_held(nodes);
  }
}

TEST(FairCurveHardStarts, HugeAndTinyCoordinates) {
  for (const double size : {1e-300, 1e150, 1e300}) {
    SCOPED_TRACE(size);
    Draw draw(8);
    std::vector<Vector3> nodes;
    nodes.reserve(30);
    for (int i = 0; i < 30; ++i) nodes.emplace_back(size * draw.in_cube(1));
    expect_sane_however_held(nodes);
  }
}

TEST(FairCurveHardStarts, OneMovingNode) {
  const double half = std::sin(60 * degree);
  const std::vector<Vector3> nodes = {{-half, 0, 0}, {0.3, 0.7, 0.2}, {half, 0, 0}};
  EXPECT_LT((faired(nodes, held_ends(nodes))[1] - Vector3(0, 0, 0)).norm(), 1e-12);
  const auto arc = faired(nodes, held_ends(nodes, heading(60 * degree), heading(-60 * degree)));
  EXPECT_LT((arc[1] - Vector3(0, 0.5, 0)).norm(), 1e-12);
}

TEST(FairCurveNormals, InThePlaneANormalActsAsTheTangent) {
  const auto start = straight({0, 0, 0}, {1, 0.3, 0}, places(Spacing::random, 50));
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    const Constraints tangents = held_ends(start, {1, 1, 0}, {1, -0.2, 0});
    Constraints normals = held_ends(start);
    normals.fix_normal(0, {1, -1, 0});
    normals.fix_normal(50, {0.2, 1, 0});
    const auto expected = faired(start, tangents, to_the_end(distribution));
    EXPECT_LT(greatest_distance(faired(start, normals, to_the_end(distribution)), expected), 1e-11);
    EXPECT_GT(greatest_distance(expected, start), 0.05);
  }
}

TEST(FairCurveNormals, InSpaceTheTangentStaysAcrossThem) {
  // As the nodes come closer, the first edge comes into the plane across the normal, with the square of the spacing.
  const Vector3 normal = Vector3(0.3, -0.4, 1).normalized();
  std::vector<double> out_of_plane;
  for (const int edges : {40, 80, 160}) {
    const auto start = straight({0, 0, 0}, {1, 0.5, 0.6}, places(Spacing::even, edges));
    Constraints constraints = held_ends(start);
    constraints.fix_normal(0, normal);
    constraints.fix_tangent(edges, {1, -1, 0.5});
    const FairResult result = fair(PolygonCurve(start), constraints, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    const auto tangents = estimate_tangents(PolygonCurve(result.positions), std::vector<Index>{0});
    out_of_plane.push_back(std::abs(tangents[0].dot(normal)));
    EXPECT_GT(std::abs((start[1] - start[0]).normalized().dot(normal)), 0.3);
  }
  SCOPED_TRACE(fmt::format("{:.2e} {:.2e} {:.2e}", out_of_plane[0], out_of_plane[1], out_of_plane[2]));
  EXPECT_LT(out_of_plane[2], 1e-3);
  EXPECT_GT(order(out_of_plane[0], out_of_plane[1]), 1.8);
  EXPECT_GT(order(out_of_plane[1], out_of_plane[2]), 1.8);
}

/// How much further nodes are from the equilibrium than the report says, at least and at most, and than was asked for.
struct Believed {
  double least_of_expected = 1e300;
  double of_expected = 0;
  double of_tolerance = 0;
};

Believed believed(const std::vector<Vector3>& start, const Constraints& constraints) {
  Believed worst;
  const std::vector<Vector3> truth = faired(start, constraints, to_the_end(Distribution::smooth));
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
    FairOptions options;
    options.method = EquilibriumMethod{.tolerance = tolerance};
    options.distribution = Distribution::smooth;
    const FairResult result = fair(PolygonCurve(start), constraints, options);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LE(*result.report.expected_error, tolerance);
    const double error = greatest_distance(result.positions, truth) / diagonal(start);
    worst.least_of_expected = std::min(worst.least_of_expected, error / *result.report.expected_error);
    worst.of_expected = std::max(worst.of_expected, error / *result.report.expected_error);
    worst.of_tolerance = std::max(worst.of_tolerance, error / tolerance);
  }
  return worst;
}

TEST(FairCurveReport, TheExpectedErrorCanBeBelieved) {
  for (const int edges : {20, 100, 1000}) {
    const auto at = places(Spacing::even, edges);
    const auto chord = straight({0, 0, 0}, {1, 0, 0}, at);
    const auto in_space = straight({0, 0, 0}, {1, 0.5, 0.4}, at);
    Constraints spline = held_ends(chord);
    spline.fix_position(edges / 3, {0.3, 0.1, 0});
    spline.fix_position(edges / 2, {0.55, 0.05, 0});
    const Constraints clothoid = held_ends(chord, heading(-1.2), heading(0.4));
    for (const Believed& worst : {
             believed(chord, held_ends(chord, heading(1), heading(-1))),
             believed(chord, clothoid),
             believed(noisy(chord, clothoid, 0.3 / edges, 4, true), clothoid),
             believed(chord, spline),
             believed(in_space, held_ends(in_space, {1, 0, 0.3}, {0.2, 1, 0.5})),
         }) {
      EXPECT_GT(worst.least_of_expected, 1.0 / 3);
      EXPECT_LT(worst.of_expected, 3);
      EXPECT_LT(worst.of_tolerance, 1);
    }
  }
}

TEST(FairCurveReport, TheExpectedErrorCanBeBelievedAfterHeavyNoise) {
  // It is a prediction: the best there is to say is that it is hardly ever off by more than a small factor.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto line = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 29));
    const Constraints ends = held_ends(line);
    const Believed worst = believed(noisy(line, ends, 1.0 / 29, seed, seed % 2 == 0), ends);
    EXPECT_LT(worst.of_expected, 3) << seed;
    EXPECT_LT(worst.of_tolerance, 2) << seed;
  }
}

TEST(FairCurveReport, TellsHowFarItIsAndMayBeCancelledThere) {
  const auto start = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 400));
  const Constraints constraints = held_ends(start, heading(1), heading(-1));
  const FairOptions sweeps = {.method = SweepMethod{.step_tolerance = 1e-300, .max_iterations = 1'000'000'000}};
  Context context;
  std::vector<Progress> told;
  context.on_progress = [&](const Progress& progress) {
    told.push_back(progress);
    if (progress.iteration > 1) context.cancel();
  };
  const FairResult result = fair(PolygonCurve(start), constraints, sweeps, context);
  EXPECT_EQ(result.report.outcome, Outcome::cancelled);
  ASSERT_GE(told.size(), 2U);
  for (std::size_t k = 0; k < told.size(); ++k) {
    EXPECT_GE(told[k].fraction, k > 0 ? told[k - 1].fraction : 0);
    EXPECT_LE(told[k].fraction, 1);
  }
  EXPECT_GT(told.back().fraction, 0);
  const auto last = static_cast<std::size_t>(told.back().iteration);
  ASSERT_LE(last, result.report.history.size());
  EXPECT_EQ(told.back().residual, result.report.history[last - 1]);
  EXPECT_GT(greatest_distance(result.positions, start), 0);

  const FairResult cancelled = fair(PolygonCurve(start), constraints, {}, context);
  EXPECT_EQ(cancelled.report.outcome, Outcome::cancelled);
  EXPECT_EQ(cancelled.positions, start);
}

TEST(FairCurveReport, TellsHowItWent) {
  const auto start = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 400));
  const Constraints constraints = held_ends(start, heading(1), heading(-1));
  const FairResult result = fair(PolygonCurve(start), constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.method, Method::equilibrium);
  EXPECT_EQ(result.report.nodes, 401);
  EXPECT_EQ(result.report.moving_nodes, 399);
  EXPECT_EQ(result.report.fixed_tangents, 2);
  EXPECT_EQ(result.report.history.size(), static_cast<std::size_t>(result.report.iterations));
  int iterations = 0;
  for (const LevelReport& level : result.report.levels) iterations += level.iterations;
  EXPECT_EQ(iterations, result.report.iterations);
  EXPECT_EQ(result.report.levels.back().moving_nodes, 399);
  EXPECT_DOUBLE_EQ(result.report.greatest_move, greatest_distance(result.positions, start));
  EXPECT_GT(result.report.greatest_move, 0.1);
  EXPECT_EQ(result.report.residual, *result.report.expected_error);
  EXPECT_LT(*result.report.expected_error, EquilibriumMethod().tolerance);
  const auto [before, after] = fairness_of(PolygonCurve(start), constraints, result.positions);
  EXPECT_LT(after.vspring_energy, 0.1 * before.vspring_energy);

  EXPECT_THROW((void)fair(PolygonCurve(start), constraints, {.method = EquilibriumMethod{.tolerance = 0}}), Error);
  EXPECT_THROW((void)fair(PolygonCurve(start), constraints, {.method = EquilibriumMethod{.tolerance = std::nan("")}}),
               Error);
}

}  // namespace
}  // namespace vspring::fair_curve_hard_test
