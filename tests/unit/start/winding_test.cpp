#include "start/winding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "levels/levels.hpp"
#include "spring/curve_net.hpp"
#include "support/curves.hpp"

namespace vspring::winding_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

struct Wound {
  std::vector<Vector3> nodes;
  Vector3 start;
  Vector3 end;

  [[nodiscard]] Constraints constraints() const { return held_ends(nodes, start, end); }
  [[nodiscard]] Net net(const std::vector<Vector3>& positions) const {
    return curve_levels(gather_net(PolygonCurve(positions), constraints()), Distribution::even).back().net;
  }
  [[nodiscard]] Net net() const { return net(nodes); }
};

/// Its curvature falls to half, so that a fair curve with its ends and turns is known.
reference::Clothoid clothoid(double turns) {
  const double length = 2 * pi * turns;
  return {.start = {0, 0}, .angle = 0, .curvature = 4.0 / 3, .curvature_rate = -2.0 / 3 / length, .length = length};
}

Wound spiral(double turns, int edges = 240) {
  const reference::Clothoid curve = clothoid(turns);
  return {sampled(curve, places(Spacing::even, edges)), heading(0), heading(curve.angle_at(curve.length))};
}

Wound helix(double turns, double pitch, int edges = 240) {
  Wound helix;
  const double turn = 2 * pi * turns;
  const Vector3 up(0, 0, pitch / (2 * pi));
  for (const double at : places(Spacing::even, edges)) helix.nodes.emplace_back(heading(at * turn) + at * turn * up);
  helix.start = (heading(pi / 2) + up).normalized();
  helix.end = (heading(turn + pi / 2) + up).normalized();
  return helix;
}

/// From the given tangent at the start over all edges to that at the end, in the plane z = 0.
std::vector<double> turns_of(const Net& net) {
  const auto& moving_run = net.moving_runs[0].nodes;
  std::vector<Vector3> ways = {net.tangents[moving_run.front()]};
  for (std::size_t k = 0; k + 1 < moving_run.size(); ++k)
    ways.emplace_back(net.positions[moving_run[k + 1]] - net.positions[moving_run[k]]);
  ways.push_back(net.tangents[moving_run.back()]);
  std::vector<double> turns;
  for (std::size_t k = 0; k + 1 < ways.size(); ++k)
    turns.push_back(std::atan2(ways[k].cross(ways[k + 1]).z(), ways[k].dot(ways[k + 1])));
  return turns;
}

double sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

/// The sum of all turns of the polygon, whichever way.
double turned(const Net& net) {
  const auto& moving_run = net.moving_runs[0].nodes;
  double sum = 0;
  for (std::size_t k = 1; k + 1 < moving_run.size(); ++k) {
    const Vector3 before = net.positions[moving_run[k]] - net.positions[moving_run[k - 1]];
    const Vector3 after = net.positions[moving_run[k + 1]] - net.positions[moving_run[k]];
    sum += std::atan2(before.cross(after).norm(), before.dot(after));
  }
  return sum;
}

TEST(HasUnwound, TellsAStraightenedCurveFromTheCurve) {
  for (const Wound& wound : {spiral(3), spiral(1.5), helix(4, 0.2)}) {
    Net net = wound.net();
    const std::vector<Vector3> input = net.positions;
    EXPECT_FALSE(lost_winding(net, input));
    start_from_chords(net);
    EXPECT_TRUE(lost_winding(net, input));
  }
}

TEST(HasUnwound, CountsSingleWindings) {
  // From one place to another, up at both, by two, three and four turns.
  const auto wound = [](double turns) {
    Wound made{.nodes = {}, .start = heading(pi / 2), .end = heading(pi / 2)};
    for (const double at : places(Spacing::even, 240)) made.nodes.emplace_back((1 + at) * heading(at * 2 * pi * turns));
    return made;
  };
  const Wound three = wound(3);
  const std::vector<Vector3> input = three.net().positions;
  EXPECT_FALSE(lost_winding(three.net(), input));
  for (const double turns : {2.0, 4.0}) EXPECT_TRUE(lost_winding(three.net(wound(turns).nodes), input)) << turns;
}

TEST(HasUnwound, SeesWindingsThatWentToTheEnds) {
  // In place of three turns five in a knot at the start, and two back at the end: as many in all.
  const Wound three = spiral(3);
  const std::vector<Vector3> input = three.net().positions;
  const double all = sum(turns_of(three.net()));
  const double small = 0.1;
  const Vector3 from = three.nodes.front() + Vector3(0, small, 0);
  const double last = 6 * pi * 2.0 / 3 + pi / 2;  // less than all its heading at the end: of a turn to the right
  const Vector3 to = three.nodes.back() + small * heading(last);
  std::vector<Vector3> knotted = three.nodes;
  for (std::size_t k = 1; k < 240; ++k) {
    const double at = static_cast<double>(k);
    if (k <= 120)
      knotted[k] = from + small * heading(-pi / 2 + 5 * 2 * pi * at / 120);
    else if (k >= 180)
      knotted[k] = to - small * heading(last + 2 * 2 * pi * (240 - at) / 60);
    else
      knotted[k] = from + (at - 120) / 60 * (to - from);
  }
  const Net net = three.net(knotted);
  ASSERT_NEAR(sum(turns_of(net)), all, 1e-6);
  EXPECT_TRUE(lost_winding(net, input));
}

TEST(HasUnwound, NoiseDoesNotCount) {
  for (const Wound& wound : {spiral(3), helix(4, 0.2), helix(4, 0.2, 48)}) {
    Net clean = wound.net();
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      // Of half an edge.
      const double noise = 0.5 * (wound.nodes[1] - wound.nodes[0]).norm();
      const bool planar = wound.nodes.back().z() == 0;
      const Net rough = wound.net(noisy(wound.nodes, wound.constraints(), noise, seed, planar));
      EXPECT_GT(turned(rough), 1.4 * turned(clean)) << "or it would show nothing";
      // In the same coordinates.
      std::vector<Vector3> input;
      for (const Vector3& position : rough.positions)
        input.emplace_back(position / rough.frame.scale() * clean.frame.scale());
      EXPECT_FALSE(lost_winding(clean, input));
      const std::vector<Vector3> own = rough.positions;
      EXPECT_FALSE(lost_winding(rough, own));
    }
  }
}

TEST(HasUnwound, PiecesWithoutTangentsDoNotCount) {
  const Wound wound = spiral(3);
  Net net = curve_levels(gather_net(PolygonCurve(wound.nodes), held_ends(wound.nodes)), Distribution::even).back().net;
  const std::vector<Vector3> input = net.positions;
  start_from_chords(net);
  EXPECT_FALSE(lost_winding(net, input));
}

TEST(Wind, GivesASpiralOfLinearCurvatureWithAllTurnsInThePlane) {
  for (const double windings : {1.5, 3.0, 4.5}) {
    const Wound wound = spiral(windings, 160);
    for (const std::uint64_t seed : {0U, 1U}) {
      const double noise = seed == 0 ? 0 : 0.3 * (wound.nodes[1] - wound.nodes[0]).norm();
      Net net = wound.net(noisy(wound.nodes, wound.constraints(), noise, seed, true));
      const Net before = net;
      const double all = sum(turns_of(net));
      EXPECT_GT(all, 2 * pi * windings - 0.1);
      ASSERT_TRUE(wind(net));
      for (std::size_t i = 0; i < net.positions.size(); ++i) {
        EXPECT_EQ(net.positions[i].z(), 0);
        if (i >= net.moving) {
          EXPECT_EQ(net.positions[i], before.positions[i]);
        }
      }
      const std::vector<double> turns = turns_of(net);
      EXPECT_NEAR(sum(turns), all, 1e-6);
      // Between the ends, whose nodes have half the length.
      for (std::size_t k = 2; k + 2 < turns.size() - 1; ++k)
        EXPECT_NEAR(turns[k + 1] - turns[k], turns[k] - turns[k - 1], 1e-6) << k;
      EXPECT_FALSE(lost_winding(net, before.positions));
    }
  }
}

TEST(Wind, KeepsTheTurnsOfAHelixOfSmallPitch) {
  // Of whole turns there is none nearby.
  const Wound wound = helix(4.25, 0.1, 80);
  Net net = wound.net();
  const Net before = net;
  const double all = turned(net);
  ASSERT_TRUE(wind(net));
  EXPECT_NE(net.positions, before.positions);
  EXPECT_NEAR(turned(net), all, 0.01 * all);
  EXPECT_FALSE(lost_winding(net, before.positions));
  EXPECT_LT(greatest_distance(net.positions, before.positions), 0.1);
  for (std::size_t i = before.moving; i < before.positions.size(); ++i)
    EXPECT_EQ(net.positions[i], before.positions[i]);
}

TEST(Wind, LeavesPiecesOfLessThanHalfATurnAlone) {
  Net net = spiral(0.4).net();
  const std::vector<Vector3> before = net.positions;
  EXPECT_FALSE(wind(net));
  EXPECT_EQ(net.positions, before);
  start_from_chords(net);
  EXPECT_FALSE(lost_winding(net, before));
}

TEST(Wind, WindsOnlyThePiecesThatDo) {
  // Three turns, and a straight piece from there on.
  Wound wound = spiral(3);
  for (std::size_t k = 1; k < 240; ++k) wound.nodes[k].x() += 0.01;
  const Vector3 corner = wound.nodes.back();
  for (int k = 1; k <= 40; ++k) wound.nodes.emplace_back(corner + 0.05 * k * wound.end);
  wound.nodes[260].x() += 0.01;
  Constraints constraints = held_ends(wound.nodes, wound.start, wound.end);
  hold(constraints, wound.nodes, 240);
  constraints.fix_tangent(240, wound.end);
  Net net = curve_levels(gather_net(PolygonCurve(wound.nodes), constraints), Distribution::even).back().net;
  const Net before = net;
  ASSERT_TRUE(wind(net));
  for (std::size_t i = 0; i < before.moving; ++i) {
    if (before.node[i] > 240)
      EXPECT_EQ(net.positions[i], before.positions[i]);
    else
      EXPECT_NE(net.positions[i], before.positions[i]);
  }
}

}  // namespace
}  // namespace vspring::winding_test
