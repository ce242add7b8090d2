// Curves that wind, with held ends and tangents, keep their windings.

#include <gtest/gtest.h>

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

TEST(FairCurveWindings, ASpiralOfWhichAllFairCurvesAreFarSaysSo) {
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
    EXPECT_EQ(result.report.outcome, Outcome::worse_than_input);
    // Without noise it is the input; with it, what is left without noise goes astray by less than its radius.
    EXPECT_LT(greatest_distance(result.positions, spiral.nodes), noise > 0 ? 1 : 1e-12);
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
  const FairResult result = fair(PolygonCurve(nodes, true), constraints);
  EXPECT_EQ(result.report.outcome, Outcome::worse_than_input);
  EXPECT_LE(measure(PolygonCurve(result.positions, true)).vspring_energy,
            measure(PolygonCurve(nodes, true)).vspring_energy);
  EXPECT_LE(result.report.after.vspring_energy, result.report.before.vspring_energy);
}

TEST(FairCurveWindings, AHelixOfSmallPitchStaysOne) {
  // Of whole turns there is no fair curve nearby.
  const Helix helix(4.25, 0.1, 60);
  const FairResult result = fair(PolygonCurve(rough(helix.nodes, helix.constraints, 0.2, 1, false)), helix.constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_NEAR(around_the_axis(result.positions), 4.25 * 2 * pi, 1e-6);
  EXPECT_LT(greatest_distance(result.positions, helix.nodes), 0.1);
}

TEST(FairCurveWindings, AHelixWithoutAFairCurveOfAsManyTurnsSaysSo) {
  const Helix helix(4, 4, 60);
  const auto nodes = rough(helix.nodes, helix.constraints, 0.1, 1, false);
  const FairResult result = fair(PolygonCurve(nodes), helix.constraints);
  EXPECT_EQ(result.report.outcome, Outcome::worse_than_input);
  ASSERT_FALSE(result.report.warnings.empty());
  EXPECT_NE(result.report.warnings.back().text.find("as does every fair curve with these ends"), std::string::npos);
  EXPECT_NE(result.report.warnings.back().text.find("hold a node in each winding"), std::string::npos);
  EXPECT_NEAR(around_the_axis(result.positions), 4 * 2 * pi, 1e-6);
}

}  // namespace
}  // namespace vspring::fair_curve_windings_test
