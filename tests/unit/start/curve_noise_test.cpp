#include "start/curve_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/curves.hpp"

namespace vspring::curve_noise_test {
namespace {

using namespace support;

std::vector<Vector3> smoothed(const std::vector<Vector3>& nodes, const Constraints& constraints) {
  Net curve = gather_net(PolygonCurve(nodes), constraints);
  smooth_noise(curve);
  return scatter_positions(curve, nodes, constraints, 1);
}

/// The nodes of the net itself, bit for bit.
bool stays(const std::vector<Vector3>& nodes, const Constraints& constraints, bool closed = false) {
  Net curve = gather_net(PolygonCurve(nodes, closed), constraints);
  const std::vector<Vector3> before = curve.positions;
  smooth_noise(curve);
  return curve.positions == before;
}

/// Turns of more than 90°.
int reversals(const std::vector<Vector3>& nodes) {
  int count = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
    count += (nodes[i] - nodes[i - 1]).dot(nodes[i + 1] - nodes[i]) < 0 ? 1 : 0;
  return count;
}

TEST(SmoothNoise, PutsNodesOfALineInOrder) {
  auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 40));
  std::swap(nodes[10], nodes[11]);
  std::swap(nodes[25], nodes[26]);
  const auto result = smoothed(nodes, held_ends(nodes));
  for (std::size_t i = 1; i < result.size(); ++i) EXPECT_GT(result[i].x(), result[i - 1].x()) << i;
  // Nothing but what is around them.
  for (const std::size_t i : {1U, 5U, 30U, 39U}) EXPECT_EQ(result[i], nodes[i]);
}

TEST(SmoothNoise, LeavesATrackWithoutReversals) {
  std::vector<Vector3> nodes;
  for (const double at : places(Spacing::even, 200)) nodes.emplace_back(at, 0.1 * std::sin(9 * at), 0);
  const Constraints constraints = held_ends(nodes);
  for (const bool planar : {true, false}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      // Of one edge.
      const auto track = noisy(nodes, constraints, 0.005, seed, planar);
      EXPECT_GT(reversals(track), 20);
      const auto result = smoothed(track, constraints);
      EXPECT_EQ(reversals(result), 0);
      EXPECT_LT(greatest_distance(result, nodes), 0.01);
    }
  }
}

TEST(SmoothNoise, LeavesFewReversalsOfNoiseOfTwoEdges) {
  // A single one may be a corner.
  const auto line = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 200));
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto track = noisy(line, held_ends(line), 0.01, seed, true);
    EXPECT_LT(reversals(smoothed(track, held_ends(line))), reversals(track) / 8);
  }
}

TEST(SmoothNoise, LeavesANoseOfFewNodesAndSmoothCurvesAlone) {
  // A straight side, turns one way, and the other side.
  for (const double turn : {50.0, 65.0}) {
    std::vector<Vector3> nose = {Vector3(-1, 0.02, 0), Vector3(-0.5, 0.02, 0), Vector3(0, 0, 0)};
    double angle = 0;
    for (int k = 0; k < 4; ++k) {
      nose.emplace_back(nose.back() + 0.1 * heading(angle * degree));
      angle += turn;
    }
    for (int k = 0; k < 3; ++k) nose.emplace_back(nose.back() + 0.5 * heading((angle - turn) * degree));
    EXPECT_TRUE(stays(nose, held_ends(nose))) << turn;
  }

  std::vector<Vector3> ellipse;
  for (int k = 0; k < 24; ++k) {
    const double angle = 15.0 * k * degree;
    ellipse.emplace_back(std::cos(angle), 0.2 * std::sin(angle), 0.1 * std::cos(2 * angle));
  }
  EXPECT_TRUE(stays(ellipse, Constraints(24), true));
}

TEST(SmoothNoise, LeavesNoiseThatTurnsTheCurveALittle) {
  auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 60));
  for (std::size_t i = 1; i < 60; i += 2) nodes[i].y() = 0.2 / 60;
  EXPECT_TRUE(stays(nodes, held_ends(nodes)));
}

TEST(SmoothNoise, HeldNodesAndGivenTangentsStay) {
  const auto line = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 80));
  Constraints constraints = held_ends(line);
  hold(constraints, line, 30);
  const auto nodes = noisy(line, constraints, 0.025, 5, false);
  constraints.fix_tangent(50, {1, 0, 0});
  constraints.fix_normal(60, {0, 1, 0});
  Net curve = gather_net(PolygonCurve(nodes), constraints);
  const std::vector<Vector3> before = curve.positions;
  const std::vector<Vector3> tangents = curve.tangents;
  smooth_noise(curve);
  int moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Index node = curve.node[i];
    const bool is_fixed = node == 0 || node == 30 || node == 50 || node == 60 || node == 80;
    if (is_fixed) {
      EXPECT_EQ(curve.positions[i], before[i]) << node;
    }
    moved += curve.positions[i] != before[i] ? 1 : 0;
  }
  EXPECT_GT(moved, 60);
  EXPECT_EQ(curve.tangents, tangents);
}

TEST(SmoothNoise, BringsANodeBackFromBeyondAHeldEnd) {
  auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 20));
  nodes[1] = {-0.02, 0.001, 0};
  const auto result = smoothed(nodes, held_ends(nodes));
  EXPECT_GT(result[1].x(), 0);
  EXPECT_EQ(reversals(result), 0);
  EXPECT_EQ(result[0], nodes[0]);
}

}  // namespace
}  // namespace vspring::curve_noise_test
