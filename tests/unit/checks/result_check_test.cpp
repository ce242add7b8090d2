#include "checks/result_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "spring/curve_net.hpp"
#include "support/curves.hpp"
#include "support/surfaces.hpp"

namespace vspring::result_check_test {
namespace {

using namespace support;

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// A bumpy square whose boundary is held, with its normals or without.
Net square(bool with_normals) {
  const PolygonMesh mesh = generate::add_noise(generate::plane({.columns = 8, .rows = 8}), 0.02, 3);
  return gather_net(
      mesh, with_normals ? held_boundary(mesh, [](const Vector3&) { return Vector3::UnitZ(); }) : held_boundary(mesh));
}

TEST(ResultCheck, FindsNothingWhereNothingIsWorse) {
  ThreadTeam team(1);
  for (const bool with_normals : {false, true}) {
    Net start = square(with_normals);
    const ResultCheck check(start, team);
    EXPECT_EQ(check.fault(start), "");
    Net flat = start;
    for (Vector3& p : flat.positions) p.z() = 0;
    EXPECT_EQ(check.fault(flat), "");
  }
}

TEST(ResultCheck, NamesNodesThatAreNowhereOrFarOutside) {
  ThreadTeam team(1);
  for (const bool with_normals : {false, true}) {
    Net start = square(with_normals);
    const ResultCheck check(start, team);
    const std::string node = "node " + std::to_string(start.node[5]) + " ";
    Net nowhere = start;
    nowhere.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(contains(check.fault(nowhere), node.c_str())) << check.fault(nowhere);
    Net outside = start;
    outside.positions[5].z() += 50;
    EXPECT_TRUE(contains(check.fault(outside), node.c_str())) << check.fault(outside);
    // A normal may ask for a wide bulge.
    Net bulged = start;
    for (std::size_t i = 0; i < bulged.moving; ++i) bulged.positions[i].z() += 4;
    EXPECT_EQ(contains(check.fault(bulged), "outside"), !with_normals) << check.fault(bulged);
  }
}

TEST(ResultCheck, TellsWhatShrinksBetweenEndsThatLieClose) {
  ThreadTeam team(1);
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 60; ++k) nodes.emplace_back(std::cos(0.1 * k), std::sin(0.1 * k), 0);
  const Net start = gather_net(PolygonCurve(nodes), held_ends(nodes));
  const ResultCheck check(start, team);
  Net line = start;
  const auto line_of = [&](double share) {
    for (std::size_t i = 0; i < line.moving; ++i) {
      const double u = static_cast<double>(start.node[i]) / 60;
      const Vector3 chord = (1 - u) * nodes.front() + u * nodes.back();
      line.positions[i] =
          start.frame.to_local(chord + share * (nodes[static_cast<std::size_t>(start.node[i])] - chord));
    }
  };
  line_of(0.3);
  EXPECT_EQ(check.fault(line).find("shrink"), std::string::npos);
  line_of(0);
  EXPECT_TRUE(contains(check.fault(line), "shrinks to 14 % of its size")) << check.fault(line);
}

TEST(ResultCheck, WhatIsDraggedShrinksToo) {
  ThreadTeam team(1);
  // An arc whose end goes so far to its start, and that becomes the straight line between both.
  const auto fault_of_line = [&](double angle, double share) {
    std::vector<Vector3> nodes;
    for (int k = 0; k <= 60; ++k) nodes.emplace_back(std::cos(angle * k / 60), std::sin(angle * k / 60), 0);
    const ResultCheck check(gather_net(PolygonCurve(nodes), held_ends(nodes)), team);
    const Vector3 end = share * nodes.front() + (1 - share) * nodes.back();
    Constraints constraints = held_ends(nodes);
    constraints.fix_position(60, end);
    Net line = gather_net(PolygonCurve(nodes), constraints);
    for (std::size_t i = 0; i < line.moving; ++i) {
      const double u = static_cast<double>(line.node[i]) / 60;
      line.positions[i] = line.frame.to_local((1 - u) * nodes.front() + u * end);
    }
    return check.fault(line);
  };
  EXPECT_TRUE(contains(fault_of_line(6, 0.1), "shrinks")) << "its ends were close together";
  EXPECT_FALSE(contains(fault_of_line(3, 0.95), "shrinks")) << "they are dragged together";
}

TEST(ResultCheck, TellsCrossingsOfACurveOfWhichANodeIsDragged) {
  ThreadTeam team(1);
  // There along y = 0, and back along y = 1.
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 40; ++k) nodes.emplace_back(k < 21 ? k : 41 - k, k < 21 ? 0 : 1, 0);
  const auto fault = [&](const Vector3& dragged, double height) {
    Constraints constraints = held_ends(nodes);
    constraints.fix_position(10, nodes[10]);
    const ResultCheck check(gather_net(PolygonCurve(nodes), constraints), team);
    constraints.fix_position(10, dragged);
    Net now = gather_net(PolygonCurve(nodes), constraints);
    for (std::size_t i = 0; i < now.moving; ++i) {
      const double away = std::abs(now.node[i] - 15.0);
      if (away < 3) now.positions[i] += now.frame.scale() * Vector3(0, height * (1 - away / 3), 0);
    }
    return check.fault_of_places(now);
  };
  // The node is where it was dragged, and so are its two edges, which cross what is there.
  EXPECT_EQ(fault({10, 1.5, 0}, 0), "");
  // It is dragged a little, and other edges cross.
  EXPECT_TRUE(contains(fault({10, 0.2, 0}, 1.4), "cross")) << fault({10, 0.2, 0}, 1.4);
}

TEST(ResultCheck, ASpikeMayBecomeFlat) {
  ThreadTeam team(1);
  const PolygonMesh plane = generate::plane({.columns = 32, .rows = 32});
  std::vector<Vector3> spike = plane.positions();
  for (Vector3& p : spike) p.z() = 20 * std::exp(-30 * (p - Vector3(0.5, 0.5, 0)).squaredNorm());
  const PolygonMesh mesh = with_positions(plane, spike);
  const Net start = gather_net(mesh, held_boundary(mesh));
  const ResultCheck check(start, team);
  Net flat = start;
  for (std::size_t i = 0; i < flat.moving; ++i) flat.positions[i] = start.frame.to_local(plane.position(start.node[i]));
  EXPECT_EQ(check.fault(flat), "");
  // About its middle.
}

TEST(ResultCheck, ASpiralMayBecomeStraight) {
  ThreadTeam team(1);
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 600; ++k) nodes.emplace_back(1e-3 * k * std::cos(0.1 * k), 1e-3 * k * std::sin(0.1 * k), 0);
  const Net start = gather_net(PolygonCurve(nodes), held_ends(nodes));
  Net line = start;
  for (std::size_t i = 0; i < line.moving; ++i)
    line.positions[i] = start.frame.to_local(start.node[i] / 600.0 * nodes.back());
  EXPECT_EQ(ResultCheck(start, team).fault(line), "");
}

TEST(ResultCheck, CountsEdgesThatTurnBack) {
  ThreadTeam team(1);
  Net start = square(true);
  const ResultCheck check(start, team);
  Net folded = start;
  // A node goes beyond its neighbours.
  folded.positions[0] += 2.5 * (folded.positions[folded.rings.links(0)[0].node()] - folded.positions[0]);
  EXPECT_TRUE(contains(check.fault(folded), "90°")) << check.fault(folded);
  // Where it was so before, it is no worse.
  const ResultCheck of_folded(folded, team);
  EXPECT_EQ(of_folded.fault(folded), "");
  EXPECT_EQ(of_folded.fault(start), "");
}

TEST(ResultCheck, TellsWhatIsBentMoreFromNoise) {
  ThreadTeam team(1);
  const auto bowed = [](double height, double noise) {
    const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12});
    const PolygonMesh mesh = noise > 0 ? generate::add_noise(plane, noise, 3) : plane;
    Net net = gather_net(mesh, held_boundary(mesh));
    for (std::size_t i = 0; i < net.moving; ++i) {
      Vector3& p = net.positions[i];
      const Vector3& there = plane.position(net.node[i]);
      p.z() += height * std::sin(3.14159 * there.x()) * std::sin(3.14159 * there.y());
    }
    return net;
  };
  for (const double noise : {0.0, 0.02}) {
    Net start = bowed(0.1, noise);
    const ResultCheck check(start, team);
    EXPECT_EQ(check.fault(start), "");
    Net same = bowed(0.1, 0);
    EXPECT_EQ(check.fault(same), "") << "without the noise";
    Net more = bowed(0.3, 0);
    EXPECT_TRUE(contains(check.fault(more), "bent more")) << check.fault(more);
    Net little_more = bowed(0.108, noise);
    EXPECT_EQ(check.fault(little_more), "") << "fair shapes may be bent more";
  }
}

TEST(ResultCheck, TellsWhatIsBentMoreThanGivenNormalsAskFor) {
  ThreadTeam team(1);
  // A dome between rims that are held with the normals of one of height 0.1.
  const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12});
  const auto wave = [](double x) { return std::sin(std::numbers::pi * x); };
  const auto slope = [](double x) { return std::numbers::pi * std::cos(std::numbers::pi * x); };
  const auto dome = [&](double height) {
    Net net = gather_net(plane, held_boundary(plane, [&](const Vector3& p) {
                           return Vector3(-0.1 * slope(p.x()) * wave(p.y()), -0.1 * wave(p.x()) * slope(p.y()), 1);
                         }));
    for (std::size_t i = 0; i < net.moving; ++i) {
      const Vector3& there = plane.position(net.node[i]);
      net.positions[i].z() += height * wave(there.x()) * wave(there.y());
    }
    return net;
  };
  Net flat = dome(0);
  Net right = dome(0.1);
  Net high = dome(0.3);
  const std::string fault = ResultCheck(right, team).fault(high);
  EXPECT_TRUE(contains(fault, "bent more")) << fault;
  EXPECT_EQ(ResultCheck(flat, team).fault(right), "") << "it is bent more, but as the normals ask";
  EXPECT_TRUE(contains(ResultCheck(right, team).fault(flat), "bent more")) << "at a rim that it leaves";
}

TEST(ResultCheck, BendingHardlySeesHowLongCellsLie) {
  // Bands of a sphere: rows of cells of 6 : 1 bent along their columns, as sliding leaves them.
  ThreadTeam team(1);
  const auto band = [](double bent) {
    const PolygonMesh tube = generate::tube({.columns = 32, .rows = 32, .faces = generate::Faces::mixed}, 1, 1);
    std::vector<Vector3> places;
    for (const Vector3& p : tube.positions()) {
      const double height = p.z() * (1 - p.z());
      const double turn = bent * height * std::sin(40 * p.z());
      const double latitude = 0.5 * (p.z() - 0.5) + bent * height * std::sin(9 * std::atan2(p.y(), p.x()));
      const double along = std::atan2(p.y(), p.x()) + turn;
      places.emplace_back(std::cos(latitude) * std::cos(along), std::cos(latitude) * std::sin(along),
                          std::sin(latitude));
    }
    const PolygonMesh mesh = with_positions(tube, places);
    return gather_net(mesh, held_boundary(mesh));
  };
  Net even = band(0);
  const ResultCheck check(even, team);
  Net slid = band(0.05);
  EXPECT_EQ(check.fault(slid).find("bent more"), std::string::npos) << check.fault(slid);
}

TEST(ResultCheck, CountsWhatHasCollapsed) {
  ThreadTeam team(1);
  Net start = square(true);
  const ResultCheck check(start, team);
  Net collapsed = start;
  for (std::size_t i = 0; i < collapsed.moving; ++i) collapsed.positions[i] = start.positions[0];
  EXPECT_TRUE(contains(check.fault(collapsed), "no area")) << check.fault(collapsed);
  EXPECT_EQ(ResultCheck(collapsed, team).fault(start), "");
}

TEST(ResultCheck, KnowsWhatWasHeldElsewhere) {
  ThreadTeam team(1);
  Net start = square(false);
  const ResultCheck check(start, team);
  // All goes with what is held: far from where it was, and as good.
  Net dragged = start;
  for (Vector3& p : dragged.positions) p.z() += 50;
  EXPECT_EQ(check.fault_of_places(dragged), "");
  dragged.positions[0] += 2.5 * (dragged.positions[dragged.rings.links(0)[0].node()] - dragged.positions[0]);
  EXPECT_TRUE(contains(check.fault_of_places(dragged), "90°")) << check.fault_of_places(dragged);
}

TEST(ResultCheck, LooksAtTheInputAndNotAtWhatConstraintsMakeOfIt) {
  ThreadTeam team(1);
  const PolygonMesh mesh = generate::plane({.columns = 8, .rows = 8});
  Constraints constraints = held_boundary(mesh);
  // Beyond its neighbours: that is what is wanted, but nothing else is to fold.
  const Index node = 4 * 9 + 4;
  constraints.fix_position(node, mesh.position(node) + Vector3(0.3, 0, 0));
  Net start = gather_net(mesh, constraints);
  const ResultCheck check(start, team);
  EXPECT_EQ(check.fault_of_places(start), "");
  for (std::size_t i = 0; i < start.moving; ++i) {
    if (start.node[i] == 1 * 9 + 1) start.positions[i] += Vector3(0.5, 0.5, 0);
  }
  EXPECT_TRUE(contains(check.fault_of_places(start), "90°")) << check.fault_of_places(start);
}

TEST(ResultCheck, OfCurvesToo) {
  ThreadTeam team(1);
  const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 20));
  Net start = gather_net(PolygonCurve(nodes), held_ends(nodes));
  const ResultCheck check(start, team);
  EXPECT_EQ(check.fault(start), "");
  Net folded = start;
  folded.positions[4].x() += 0.2;
  EXPECT_TRUE(contains(check.fault(folded), "90°")) << check.fault(folded);
  Net collapsed = start;
  collapsed.positions[4] = collapsed.positions[5];
  EXPECT_TRUE(contains(check.fault(collapsed), "no length")) << check.fault(collapsed);
  Net wavy = start;
  for (std::size_t i = 0; i < wavy.moving; ++i) wavy.positions[i].y() += 0.01 * std::sin(static_cast<double>(9 * i));
  EXPECT_TRUE(contains(check.fault(wavy), "bent more")) << check.fault(wavy);
}

TEST(ResultCheck, CountsWhatLeavesGivenTangentsAsBent) {
  ThreadTeam team(1);
  const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 40));
  const Vector3 slope = Vector3(1, 1, 0).normalized();
  const Net start = gather_net(PolygonCurve(nodes), held_ends(nodes, slope, Vector3(1, -1, 0).normalized()));
  Net arc = start;
  for (std::size_t i = 0; i < arc.positions.size(); ++i) {
    const double x = nodes[static_cast<std::size_t>(start.node[i])].x() - 0.5;
    arc.positions[i] = start.frame.to_local({x + 0.5, std::sqrt(0.5 - x * x) - 0.5, 0});
  }
  EXPECT_EQ(ResultCheck(start, team).fault(arc), "") << "it is bent more, but as the tangents ask";
  EXPECT_TRUE(contains(ResultCheck(arc, team).fault(start), "bent more"));
}

TEST(ResultCheck, CountsTurnsOfACurveAtHeldNodesToo) {
  ThreadTeam team(1);
  auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 20));
  Constraints constraints = held_ends(nodes);
  hold(constraints, nodes, 10);
  Net start = gather_net(PolygonCurve(nodes), constraints);
  const ResultCheck check(start, team);
  Net sharp = start;
  for (std::size_t i = 0; i < sharp.moving; ++i) {
    if (sharp.node[i] == 9 || sharp.node[i] == 11)
      sharp.positions[i] += Vector3(sharp.node[i] == 9 ? 0.02 : -0.02, 0.1, 0);
  }
  EXPECT_TRUE(contains(check.fault(sharp), "90°")) << check.fault(sharp);
}

TEST(ResultCheck, SeesACurveThatCrossesItselfWhereNoTangentIsHeld) {
  ThreadTeam team(1);
  const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 40));
  for (const bool with_tangents : {false, true}) {
    const Constraints constraints =
        with_tangents ? held_ends(nodes, Vector3::UnitX(), Vector3::UnitX()) : held_ends(nodes);
    Net start = gather_net(PolygonCurve(nodes), constraints);
    const ResultCheck check(start, team);
    Net looped = start;
    const Vector3& from = start.positions[start.moving];
    const Vector3 along = start.positions[start.moving + 1] - from;
    const Vector3 up = Vector3::UnitZ().cross(along);
    for (std::size_t i = 0; i < looped.moving; ++i) {
      // Back and forth and back, over a hill.
      const double u = 3 * static_cast<double>(start.node[i]) / 40 - 1.5;
      looped.positions[i] = from + (0.5 + (u * u * u - u) / 3.75) * along + 0.15 * (2.25 - u * u) * up;
    }
    EXPECT_EQ(contains(check.fault(looped), "cross each other"), !with_tangents) << check.fault(looped);
  }
}

}  // namespace
}  // namespace vspring::result_check_test
