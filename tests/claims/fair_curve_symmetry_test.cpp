// Fairing commutes with motions, mirrors, scaling and reversal; it is the same for any number of threads, and leaves
// alone what is fair, fixed or its argument.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "support/methods.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_symmetry_test {
namespace {

using namespace support;

struct Held {
  std::vector<Vector3> nodes;
  Constraints constraints;
};

/// A noisy curve with end tangents and a fixed node in between.
Held example(bool planar, int edges = 80) {
  const Vector3 end(2, 0.4, planar ? 0 : 0.7);
  const int joint = edges / 3;
  std::vector<Vector3> nodes = straight({0, 0, 0}, {0.7, 0.4, 0}, places(Spacing::random, joint));
  const auto rest = straight(nodes.back(), end, places(Spacing::random, edges - joint));
  nodes.insert(nodes.end(), rest.begin() + 1, rest.end());
  // Of unit length to the last bit, so that giving them again does not change them.
  Constraints constraints = held_ends(nodes, {0, 1, 0}, planar ? Vector3(0, -1, 0) : Vector3(0, 0, 1));
  hold(constraints, nodes, joint);
  nodes = noisy(nodes, constraints, 0.02, 3, planar);
  return {std::move(nodes), std::move(constraints)};
}

FairOptions options_of(Distribution distribution) { return to_the_end(distribution, 1e-12); }

constexpr Distribution distributions[] = {Distribution::even, Distribution::keep};

TEST(FairCurveSymmetry, MotionsMirrorsAndScalingCommuteWithFairing) {
  for (const bool planar : {true, false}) {
    for (const Distribution distribution : distributions) {
      const auto [nodes, constraints] = example(planar);
      const auto plain = faired(nodes, constraints, options_of(distribution));
      EXPECT_GT(greatest_distance(plain, nodes), 0.1);
      for (const double scale : {1.0, 1e-30, 3e7, 1e60}) {
        for (const bool mirror : {false, true}) {
          Motion motion;
          motion.scale = scale;
          motion.shift *= scale;
          if (mirror) motion.turn = motion.turn * Vector3(1, -1, 1).asDiagonal();
          const auto result = faired(motion.points(nodes), motion.constraints(constraints), options_of(distribution));
          EXPECT_LT(greatest_distance(result, motion.points(plain)) / scale, 1e-11)
              << "scale " << scale << (mirror ? ", mirrored" : "") << (planar ? ", planar" : "");
        }
      }
    }
  }
}

TEST(FairCurveSymmetry, ScalingByPowersOfTwoChangesNoBitButTheExponent) {
  for (const bool planar : {true, false}) {
    const auto [nodes, constraints] = example(planar);
    Motion motion;
    motion.turn.setIdentity();
    motion.shift.setZero();
    const auto plain = fair(PolygonCurve(nodes), constraints);
    for (const double scale : {0x1p-300, 0x1p-1, 0x1p7, 0x1p300}) {
      motion.scale = scale;
      const auto result = fair(PolygonCurve(motion.points(nodes)), motion.constraints(constraints));
      EXPECT_EQ(result.positions, motion.points(plain.positions)) << scale;
      EXPECT_EQ(result.report.history, plain.report.history);
    }
  }
}

TEST(FairCurveSymmetry, ReversalCommutesWithFairing) {
  for (const bool planar : {true, false}) {
    for (const Distribution distribution : distributions) {
      const auto [nodes, constraints] = example(planar);
      const auto plain = faired(nodes, constraints, options_of(distribution));
      const auto last = static_cast<Index>(nodes.size()) - 1;
      const std::vector<Vector3> reversed(nodes.rbegin(), nodes.rend());
      Constraints turned(last + 1);
      for (Index i = 0; i <= last; ++i) {
        if (constraints.position_fixed(i)) turned.fix_position(last - i, constraints.position(i));
        if (constraints.tangent_fixed(i)) turned.fix_tangent(last - i, -constraints.tangent(i));
      }
      auto result = faired(reversed, turned, options_of(distribution));
      std::reverse(result.begin(), result.end());
      EXPECT_LT(greatest_distance(result, plain), 1e-11);
    }
  }
}

TEST(FairCurveSymmetry, NodeNumbersDoNotMatter) {
  const auto [nodes, constraints] = example(false);
  const auto plain = faired(nodes, constraints, options_of(Distribution::keep));
  // Node i of the curve is node 37 i of all, modulo their number.
  const auto count = static_cast<Index>(nodes.size());
  std::vector<Vector3> shuffled(nodes.size());
  PolygonCurve::Chain chain;
  Constraints moved(count);
  for (Index i = 0; i < count; ++i) {
    const Index to = 37 * i % count;
    chain.nodes.push_back(to);
    shuffled[static_cast<std::size_t>(to)] = nodes[static_cast<std::size_t>(i)];
    if (constraints.position_fixed(i)) moved.fix_position(to, constraints.position(i));
    if (constraints.tangent_fixed(i)) moved.fix_tangent(to, constraints.tangent(i));
  }
  const auto result = fair(PolygonCurve(shuffled, {chain}), moved, options_of(Distribution::keep)).positions;
  for (Index i = 0; i < count; ++i)
    EXPECT_EQ(result[static_cast<std::size_t>(37 * i % count)], plain[static_cast<std::size_t>(i)]);
}

TEST(FairCurveSymmetry, ThreadsGiveTheSameBits) {
  for (const FairingMethod& method :
       {FairingMethod(equilibrium_alone()), FairingMethod(SweepMethod{.max_iterations = 20})}) {
    const auto [nodes, constraints] = example(false, 20000);
    const auto run = [&, &nodes = nodes, &constraints = constraints](int threads) {
      Context context;
      context.threads = threads;
      return fair(PolygonCurve(nodes), constraints, {.method = method}, context);
    };
    const FairResult one = run(1);
    EXPECT_NE(one.positions, nodes);
    for (const int threads : {2, 5}) {
      const FairResult several = run(threads);
      EXPECT_EQ(several.report.threads, threads);
      EXPECT_EQ(several.positions, one.positions);
      EXPECT_EQ(several.report.history, one.report.history);
    }
  }
}

TEST(FairCurveSymmetry, FairingAFairCurveAgainChangesNothing) {
  for (const bool planar : {true, false}) {
    for (const Distribution distribution : distributions) {
      const auto [nodes, constraints] = example(planar);
      const auto once = faired(nodes, constraints, options_of(distribution));
      const FairResult twice = fair(PolygonCurve(once), constraints, options_of(distribution));
      EXPECT_EQ(twice.report.outcome, Outcome::converged);
      EXPECT_LE(twice.report.iterations, 2);
      EXPECT_LT(greatest_distance(twice.positions, once), 1e-11);
    }
  }
}

TEST(FairCurveSymmetry, FixedNodesComeOutBitForBitAndArgumentsAreUnchanged) {
  auto [nodes, constraints] = example(false);
  constraints.fix_position(50, {0.1 + 0.2, 1.0 / 3, 0.7});
  const PolygonCurve curve(nodes);
  const Constraints before = constraints;
  const FairResult result = fair(curve, constraints);
  EXPECT_EQ(curve.positions(), nodes);
  Index fixed = 0;
  for (Index i = 0; i < curve.node_count(); ++i) {
    EXPECT_EQ(constraints.position_fixed(i), before.position_fixed(i));
    EXPECT_EQ(constraints.tangent_fixed(i), before.tangent_fixed(i));
    if (!constraints.position_fixed(i)) continue;
    ++fixed;
    EXPECT_EQ(constraints.position(i), before.position(i));
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], constraints.position(i));
  }
  EXPECT_EQ(fixed, 4);
  EXPECT_EQ(result.report.fixed_positions, 4);
  EXPECT_EQ(result.report.fixed_tangents, 2);
  EXPECT_EQ(result.report.moving_nodes, curve.node_count() - 4);
}

TEST(FairCurveSymmetry, StrengthGoesPartOfTheWay) {
  const auto [nodes, constraints] = example(false);
  FairOptions options;
  const auto whole = faired(nodes, constraints, options);
  options.strength = 0.25;
  const auto quarter = faired(nodes, constraints, options);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_LT((quarter[i] - (nodes[i] + 0.25 * (whole[i] - nodes[i]))).norm(), 1e-14);
  options.strength = 0;
  EXPECT_EQ(faired(nodes, constraints, options), nodes);
}

}  // namespace
}  // namespace vspring::fair_curve_symmetry_test
