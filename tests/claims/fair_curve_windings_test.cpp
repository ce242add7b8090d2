// Curves that wind, with held ends and tangents, keep their windings; where no fair curve is found, they stay near the
// input.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_windings_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

/// The sum of all turns in the plane, signed, with those from and to the given tangents.
double turned(const std::vector<Vector3>& nodes, const Constraints& constraints) {
  std::vector<Vector3> ways = {constraints.tangent(0)};
  for (std::size_t i = 1; i < nodes.size(); ++i) ways.emplace_back(nodes[i] - nodes[i - 1]);
  ways.push_back(constraints.tangent(constraints.node_count() - 1));
  double sum = 0;
  for (std::size_t k = 1; k < ways.size(); ++k)
    sum += std::atan2(ways[k - 1].cross(ways[k]).z(), ways[k - 1].dot(ways[k]));
  return sum;
}

/// The angle by which nodes go round the axis along z through the origin.
double around_the_axis(const std::vector<Vector3>& nodes) {
  double sum = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Vector3& a = nodes[i - 1];
    const Vector3& b = nodes[i];
    sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
  }
  return sum;
}

/// Noise of this share of the first edge, but not at the ends.
std::vector<Vector3> rough(const std::vector<Vector3>& nodes, const Constraints& constraints, double share,
                           std::uint64_t seed, bool planar) {
  return noisy(nodes, constraints, share * (nodes[1] - nodes[0]).norm(), seed, planar);
}

void expect_clothoid(const reference::Clothoid& curve, double share, std::uint64_t seed) {
  const auto nodes = sampled(curve, places(Spacing::even, 160));
  const Constraints constraints = held_ends(nodes, heading(curve.angle), heading(curve.angle_at(curve.length)));
  const FairResult result = fair(PolygonCurve(rough(nodes, constraints, share, seed, true)), constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_NEAR(turned(result.positions, constraints), curve.angle_at(curve.length) - curve.angle, 1e-6);
  EXPECT_LT(distance_from(curve, result.positions), 3e-3 * diagonal(nodes));
}

bool tells(const std::vector<Warning>& warnings, WarningCode code) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const Warning& warning) { return warning.code == code; });
}

/// Σ θ²/ℓ.
double bending_of_closed(const std::vector<Vector3>& nodes) {
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector3 before = nodes[i] - nodes[(i + nodes.size() - 1) % nodes.size()];
    const Vector3 after = nodes[(i + 1) % nodes.size()] - nodes[i];
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    sum += 2 * turn * turn / (before.norm() + after.norm());
  }
  return sum;
}

struct Helix {
  std::vector<Vector3> nodes;
  Constraints constraints;

  Helix(double turns, double pitch, int edges) : constraints(0) {
    const double turn = 2 * pi * turns;
    const Vector3 up(0, 0, pitch / (2 * pi));
    for (const double at : places(Spacing::even, edges)) nodes.emplace_back(heading(at * turn) + at * turn * up);
    constraints = held_ends(nodes, heading(pi / 2) + up, heading(turn + pi / 2) + up);
  }
};

TEST(FairCurveWindings, SpiralsKeepAllTheirTurns) {
  for (const double turns : {1.5, 3.0, 4.5}) {
    SCOPED_TRACE(turns);
    // Of twice the curvature inside.
    const double length = 2 * pi * turns;
    const reference::Clothoid spiral{.curvature = 4.0 / 3, .curvature_rate = -2.0 / 3 / length, .length = length};
    expect_clothoid(spiral, 0.3, 1);
  }
}

TEST(FairCurveWindings, SpiralsWindWhereTheyDid) {
  // Clothoids with the same ends and as many turns, but nearly all of them in a knot, are equilibria too.
  const double length = 2 * pi * 2.3;
  const reference::Clothoid spiral{.curvature = 4.0 / 3, .curvature_rate = -2.0 / 3 / length, .length = length};
  struct Spaced {
    Spacing spacing;
    int edges;
  };
  for (const auto& [spacing, edges] : {Spaced{Spacing::even, 60}, Spaced{Spacing::graded, 180}}) {
    SCOPED_TRACE(edges);
    const auto nodes = sampled(spiral, places(spacing, edges, 8));
    const Constraints constraints = held_ends(nodes, heading(spiral.angle), heading(spiral.angle_at(spiral.length)));
    const FairResult result = fair(PolygonCurve(nodes), constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from(spiral, result.positions), 0.02 * diagonal(nodes));
  }
}

TEST(FairCurveWindings, ASpiralOfWhichAllEulerSpiralsAreFarStaysNearTheInput) {
  // Little more than one turn, from a place to one twice as far out: all clothoids with these ends and as many turns
  // go to and fro, or wind at one end.
  Helix spiral(1.1, 0, 100);
  for (std::size_t k = 0; k < spiral.nodes.size(); ++k) spiral.nodes[k] *= 1 + static_cast<double>(k) / 100;
  const auto along = [&](double at) {
    const double angle = 1.1 * 2 * pi * at;
    return Vector3(heading(angle) + 1.1 * 2 * pi * (1 + at) * heading(angle + pi / 2));
  };
  spiral.constraints = held_ends(spiral.nodes, along(0), along(1));
  for (const double noise : {0.0, 0.1}) {
    SCOPED_TRACE(noise);
    const auto nodes = rough(spiral.nodes, spiral.constraints, noise, 1, true);
    const FairResult result = fair(PolygonCurve(nodes), spiral.constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_TRUE(tells(result.report.warnings, WarningCode::other_fairness));
    EXPECT_NEAR(turned(result.positions, spiral.constraints), turned(spiral.nodes, spiral.constraints), 1e-6);
    EXPECT_LT(greatest_distance(result.positions, spiral.nodes), 0.02 * diagonal(spiral.nodes));
  }
}

TEST(FairCurveWindings, AnOutlineBetweenEndsThatLieTogetherStays) {
  // Springs draw it in to its ends; tangents there ask for a loop elsewhere.
  std::vector<Vector3> outline;
  for (int k = 0; k <= 200; ++k) {
    const double t = 2 * pi * (0.005 + 0.99 * k / 200);
    outline.emplace_back(0.5 + 0.5 * std::cos(t), 0.06 * std::sin(t) * (1.5 - std::cos(t)), 0);
  }
  Constraints constraints = held_ends(outline, Vector3(-0.98, 0.2, 0), Vector3(0.98, 0.2, 0));
  for (const double noise : {0.0, 0.4}) {
    SCOPED_TRACE(noise);
    const auto nodes = noisy(outline, constraints, noise * 0.01, 1, true);
    const FairResult result = fair(PolygonCurve(nodes), constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(greatest_distance(result.positions, outline), 0.1);
  }
}

TEST(FairCurveWindings, LoopsBothWaysStay) {
  // What counts is the sum: with one turn and more each way some could go.
  struct Loops {
    double left;
    double right;
  };
  for (const auto& [left, right] : {Loops{0.8, 0.8}, Loops{2.2, 1.1}}) {
    SCOPED_TRACE(left);
    const double length = 10;
    const double straight_at = length / (1 + std::sqrt(right / left));
    const double curvature = 4 * pi * left / straight_at;
    expect_clothoid({.curvature = curvature, .curvature_rate = -curvature / straight_at, .length = length}, 0.3, 2);
  }
}

TEST(FairCurveWindings, HeldNeighboursAreNoHinge) {
  // No Euler spiral has the lobe of this figure eight between two held nodes: one would end with a jump of curvature
  // from the first of two held neighbours to the second, where nothing moves.
  std::vector<Vector3> nodes;
  for (int k = 0; k < 140; ++k) {
    const double t = 2 * pi * k / 140 + pi / 2;
    nodes.emplace_back(5 * std::cos(t), 5 * std::sin(t) * std::cos(t), 0);
  }
  Constraints constraints(140);
  for (const Index i : {20, 50, 72, 137, 138}) constraints.fix_position(i, nodes[static_cast<std::size_t>(i)]);
  const PolygonCurve eight(nodes, true);
  const FairResult result = fair(eight, constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_TRUE(tells(result.report.warnings, WarningCode::other_fairness));
  EXPECT_LT(bending_of_closed(result.positions), bending_of_closed(nodes));
}

TEST(FairCurveWindings, AHelixOfSmallPitchStaysOne) {
  // Of whole turns there is no fair curve nearby.
  const Helix helix(4.25, 0.1, 60);
  const FairResult result = fair(PolygonCurve(rough(helix.nodes, helix.constraints, 0.2, 1, false)), helix.constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_NEAR(around_the_axis(result.positions), 4.25 * 2 * pi, 1e-6);
  EXPECT_LT(greatest_distance(result.positions, helix.nodes), 0.1);
}

TEST(FairCurveWindings, AHelixWithoutAFairCurveOfAsManyTurnsStaysOne) {
  const Helix helix(4, 4, 60);
  const auto nodes = rough(helix.nodes, helix.constraints, 0.1, 1, false);
  const FairResult result = fair(PolygonCurve(nodes), helix.constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  ASSERT_TRUE(tells(result.report.warnings, WarningCode::other_fairness));
  EXPECT_NE(result.report.warnings.back().text.find("it winds otherwise than the input"), std::string::npos);
  EXPECT_NEAR(around_the_axis(result.positions), 4 * 2 * pi, 1e-6);
  EXPECT_LT(greatest_distance(result.positions, helix.nodes), 0.1);
}

}  // namespace
}  // namespace vspring::fair_curve_windings_test
