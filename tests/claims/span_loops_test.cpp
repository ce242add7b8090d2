// Which loops of a network of curves are spanned: where curves meet, lids, outer rims, choices, and what is refused.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/curve_networks.hpp"
#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::span_loops_test {
namespace {

using namespace support;
using namespace support::networks;

TEST(SpanLoops, FacesLookOutwards) {
  const auto facing = [](const SpannedCurves& spanned, const Vector3& from) {
    double sum = 0;
    for (Index f = 0; f < spanned.mesh.face_count(); ++f) {
      const auto face = spanned.mesh.face(f);
      const Vector3& a = spanned.mesh.position(face[0]);
      sum += (spanned.mesh.position(face[1]) - a).cross(spanned.mesh.position(face[2]) - a).dot(a - from);
    }
    return sum;
  };
  Curves bowl;  // the lower half of a sphere
  bowl.add_grid(
      [](double u, double v) { return Vector3(-on_sphere(u, v).z(), on_sphere(u, v).y(), -on_sphere(u, v).x()); }, 2,
      2);
  EXPECT_GT(facing(span_curves(bowl.take()), Vector3::Zero()), 0);
  Curves sheet;
  sheet.add_line({0, 0, 1}, {0, 1, 1});
  sheet.add_line({0, 1, 1}, {1, 1, 1});
  sheet.add_line({1, 1, 1}, {1, 0, 1});
  sheet.add_line({1, 0, 1}, {0, 0, 1});
  EXPECT_GT(facing(span_curves(sheet.take()), Vector3::Zero()), 0);
}

TEST(SpanLoops, LeavesTheEndsOfATubeOpen) {
  for (const int meridians : {1, 2, 4}) {
    const SpannedCurves tube = span_curves(cylinder(meridians, 3).take(), exact());
    EXPECT_TRUE(tube.usable());
    EXPECT_EQ(count(tube, LoopState::lid) + count(tube, LoopState::outer), 2) << meridians;
    EXPECT_EQ(count(tube, LoopState::spanned), 2 * meridians);
    EXPECT_EQ(boundary_loops(tube.mesh).size(), 2U);
    double most = 0;
    for (const Vector3& place : tube.positions) most = std::max(most, std::abs(place.head<2>().norm() - 1));
    EXPECT_LT(most, 1e-7) << meridians;
  }
}

TEST(SpanLoops, SpansLidsThatAreAskedForOrSharp) {
  const Curves curves = cylinder(4, 3);
  SpanOptions options = exact();
  const SpannedCurves open = span_curves(curves.take(), options);
  for (std::size_t l = 0; l < open.loops.size(); ++l) {
    if (open.loops[l].state == LoopState::lid) options.also.push_back(static_cast<Index>(l));
  }
  ASSERT_EQ(options.also.size(), 2U);
  const SpannedCurves closed = span_curves(curves.take(), options);
  EXPECT_TRUE(boundary_loops(closed.mesh).empty());
  expect_no_defects(closed.mesh);
  // Smooth over its ends, it bulges there.
  EXPECT_GT(volume(closed), 3 * pi);

  options.also.clear();
  options.sharp = {4, 6};  // the first and the last parallel
  const SpannedCurves can = span_curves(curves.take(), options);
  EXPECT_TRUE(can.usable());
  EXPECT_TRUE(boundary_loops(can.mesh).empty());
  EXPECT_FALSE(can.sharp_edges.empty());
  for (const Vector3& place : can.positions) {
    const double to_wall = std::abs(place.head<2>().norm() - 1);
    const double to_lids = std::min(std::abs(place.z()), std::abs(place.z() - 3));
    EXPECT_LT(std::min(to_wall, to_lids), 1e-7);
  }
}

TEST(SpanLoops, SharpCurvesDoNotCloseASheet) {
  Curves curves;
  curves.add_grid(on_sphere, 2, 2);
  SpanOptions options;
  for (Index c = 0; c < 6; ++c) options.sharp.push_back(c);
  const SpannedCurves spanned = span_curves(curves.take(), options);
  EXPECT_EQ(count(spanned, LoopState::outer), 1);
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  // Only the two inner lines have a surface on both sides.
  const auto at_end = boundary_nodes(spanned.mesh);
  for (const auto& [a, b] : spanned.sharp_edges)
    EXPECT_FALSE(at_end[static_cast<std::size_t>(a)] != 0 && at_end[static_cast<std::size_t>(b)] != 0) << a << " " << b;
  for (const NetworkLoop& loop : spanned.loops) {
    if (loop.state == LoopState::spanned) {
      EXPECT_LT(loop.turn, 10);
    }
  }
}

TEST(SpanLoops, FacesOfACubeAreNoLids) {
  SpanOptions options = exact();
  const SpannedCurves round = span_curves(cube().take(), options);
  EXPECT_EQ(count(round, LoopState::spanned), 6);
  EXPECT_TRUE(boundary_loops(round.mesh).empty());
  EXPECT_GT(volume(round), 1.1);
  for (Index c = 0; c < 12; ++c) options.sharp.push_back(c);
  const SpannedCurves sharp = span_curves(cube().take(), options);
  EXPECT_TRUE(sharp.usable());
  EXPECT_NEAR(volume(sharp), 1, 1e-9);
}

TEST(SpanLoops, JoinsCurvesThatNearlyMeet) {
  // The middle curve ends short of its neighbours and beyond them, the crossing one passes it at a distance.
  Curves curves;
  curves.add_line({0, 0, 0}, {2, 0, 0});
  curves.add_line({2, 0, 0}, {2, 1, 0});
  curves.add_line({2, 1, 0.001}, {0, 1, 0.001});
  curves.add_line({0, 1, 0}, {0, 0, 0});
  curves.add_line({0.9, 0.001, 0}, {0.9, 1.001, 0});
  curves.add_line({0.001, 0.4, 0.001}, {1.999, 0.4, 0.001});
  const SpannedCurves spanned = span_curves(curves.take());
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  EXPECT_TRUE(spanned.report.warnings.empty());
  expect_no_defects(spanned.mesh);
  SpanOptions options;
  options.join = 1e-5;
  EXPECT_EQ(
      refusal([&] { (void)span_curves(curves.take(), options); }, ErrorCode::unusable_shape),
      "no curves make a loop that a surface could span, as they end freely at nodes 3, 4, 5, 6, 8 and 3 more; join "
      "curves that are further apart than 1e-05, or add curves between their ends");
}

TEST(SpanLoops, NodesMayBeNearerThanCurvesThatMeet) {
  Curves curves;
  curves.add_grid([](double u, double v) { return Vector3(u, v, 0.1 * u * v); }, 2, 2, 4001);
  const SpannedCurves spanned = span_curves(curves.take());
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  EXPECT_TRUE(spanned.report.warnings.empty());
}

TEST(SpanLoops, NodesMayBeRepeatedAndCurvesDrawnTwice) {
  std::vector<Vector3> places;
  std::vector<PolygonCurve::Chain> chains;
  const auto add = [&](const std::function<Vector3(double)>& at, int nodes, bool repeats) {
    PolygonCurve::Chain chain;
    for (int k = 0; k < nodes; ++k) {
      for (int times = repeats && (k == 0 || k + 1 == nodes) ? 2 : 1; times > 0; --times) {
        chain.nodes.push_back(static_cast<Index>(places.size()));
        places.push_back(at(static_cast<double>(k) / (nodes - 1)));
      }
    }
    chains.push_back(chain);
  };
  for (int i = 0; i <= 2; ++i) {
    add([=](double t) { return on_sphere(t, 0.5 * i); }, 9, true);
    add([=](double t) { return on_sphere(0.5 * i, t); }, 9, true);
  }
  // The middle one the other way, and an outer one with other nodes.
  add([](double t) { return on_sphere(1 - t, 0.5); }, 9, false);
  add([](double t) { return on_sphere(0, t); }, 14, false);
  const SpannedCurves spanned = span_curves(PolygonCurve(places, chains), exact());
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  EXPECT_EQ(spanned.loops.size(), 5U);
  EXPECT_TRUE(spanned.report.warnings.empty());
  EXPECT_LT(from_unit_sphere(spanned.positions), 1e-4);
}

TEST(SpanLoops, CurvesOfFewNodesHaveNoCornerBesideJunctions) {
  std::vector<Vector3> places;
  std::vector<PolygonCurve::Chain> circles(3);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    PolygonCurve::Chain& circle = circles[static_cast<std::size_t>(axis)];
    circle.closed = true;
    for (int k = 0; k < 8; ++k) {
      Vector3 place = Vector3::Zero();
      place[(axis + 1) % 3] = std::cos(pi * k / 4);
      place[(axis + 2) % 3] = std::sin(pi * k / 4);
      circle.nodes.push_back(static_cast<Index>(places.size()));
      places.push_back(place);
    }
  }
  const SpannedCurves spanned = span_curves(PolygonCurve(places, circles), exact());
  EXPECT_EQ(spanned.curves.size(), 12U);
  EXPECT_EQ(count(spanned, LoopState::spanned), 8);
  EXPECT_LT(from_unit_sphere(spanned.positions), 1e-4);
}

TEST(SpanLoops, RidgesMayBeSharpAndTrailingEdgesThin) {
  // Two wings: of two planes at 20 degrees, and a thin closed profile that begins at its sharp edge.
  Curves ridge;
  const double high = std::tan(10 * pi / 180);
  for (const double x : {0.0, 1.0, 2.0}) {
    for (const double side : {-1.0, 1.0}) ridge.add_line({x, 0, 0}, {x, 1, side * high});
  }
  ridge.add_line({0, 0, 0}, {2, 0, 0});
  for (const double side : {-1.0, 1.0}) ridge.add_line({0, 1, side * high}, {2, 1, side * high});
  SpanOptions options = exact();
  options.sharp = {6};
  const SpannedCurves planes = span_curves(ridge.take(), options);
  EXPECT_EQ(count(planes, LoopState::spanned), 4);
  for (const Vector3& place : planes.positions) EXPECT_NEAR(std::abs(place.z()), high * place.y(), 1e-9);

  Curves wing;
  const auto profile = [](double t, double y) {
    const double x = std::pow(std::cos(pi * t), 2);
    return Vector3(x, y, 0.12 * std::sin(2 * pi * t) * std::sin(pi * t));
  };
  for (const double y : {0.0, 0.1, 0.2}) wing.add([&](double t) { return profile(t, y); }, 81);
  wing.add_line({1, 0, 0}, {1, 0.2, 0});
  wing.add_line({0, 0, 0}, {0, 0.2, 0});
  options.sharp = {3};
  options.flat = true;
  EXPECT_EQ(count(span_curves(wing.take(), options), LoopState::spanned), 4);
}

TEST(SpanLoops, PolylinesAreStraightBetweenTheirCorners) {
  // A frame of four corners, joined across within its edges and at a node between two of them.
  PolygonCurve::Chain frame{.nodes = {0, 1, 2, 3, 4}, .closed = true};
  PolygonCurve::Chain across{.nodes = {5, 6}};
  PolygonCurve::Chain along{.nodes = {7, 4}};
  const PolygonCurve network(
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0.5, 0}, {0.7, 0, 0}, {0.7, 1, 0}, {2, 0.5, 0}},
      {frame, across, along});
  const SpannedCurves spanned = span_curves(network);
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  double area = 0;
  for (Index f = 0; f < spanned.mesh.face_count(); ++f) {
    const auto face = spanned.mesh.face(f);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Vector3& corner = spanned.mesh.position(face[0]);
      area += (spanned.mesh.position(face[k]) - corner).cross(spanned.mesh.position(face[k + 1]) - corner).norm() / 2;
    }
  }
  EXPECT_NEAR(area, 2, 1e-12);
}

TEST(SpanLoops, CurvesMayHaveACornerWhereTheyCrossASharpOne) {
  // Two planes 20 degrees apart, with a curve from one to the other beside the frame's.
  const double z = std::tan(20 * pi / 180);
  Curves curves;
  for (const double y : {0.0, 0.4, 1.0})
    curves.add([&](double t) { return Vector3(2 * t - 1, y, std::max(0.0, z * (2 * t - 1))); }, 3);
  for (const double x : {-1.0, 0.0, 1.0}) curves.add_line({x, 0, std::max(0.0, z * x)}, {x, 1, std::max(0.0, z * x)});
  SpanOptions options = exact();
  options.sharp = {4};
  const SpannedCurves spanned = span_curves(curves.take(), options);
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  for (const Vector3& place : spanned.mesh.positions()) EXPECT_NEAR(place.z(), std::max(0.0, z * place.x()), 1e-9);
}

TEST(SpanLoops, ACurveStaysWhereAnotherOneEndsBesideIt) {
  // A middle line ends short of a circle and beyond it.
  const auto on_circle = [](double a, double z) { return Vector3(std::cos(a), std::sin(a), z); };
  Curves curves;
  for (const double z : {0.0, 1.0}) curves.add([&](double t) { return on_circle(1.2 * t, z); }, 9);
  for (const double a : {0.0, 1.2}) curves.add_line(on_circle(a, 0), on_circle(a, 1));
  curves.add_line(0.9995 * on_circle(0.7, 0), 1.0005 * on_circle(0.7, 1));
  const SpannedCurves spanned = span_curves(curves.take());
  EXPECT_EQ(count(spanned, LoopState::spanned), 2);
  for (const NetworkCurve& curve : spanned.curves) {
    for (const Index node : curve.nodes) {
      const Vector3& place = spanned.mesh.position(node);
      if (std::abs(place.z()) > 1e-9 && std::abs(place.z() - 1) > 1e-9) continue;
      // Cubics through nine nodes are some 1e-7 off; the line's ends are 5e-4 off.
      EXPECT_NEAR(place.head<2>().norm(), 1, 1e-5);
    }
  }
}

TEST(SpanLoops, WarnsOfCurvesThatBoundNothing) {
  Curves curves;
  curves.add_grid(on_sphere, 1, 1);
  curves.add_line(on_sphere(0, 0), {2, 2, 2});
  const SpannedCurves spanned = span_curves(curves.take());
  EXPECT_EQ(count(spanned, LoopState::spanned), 1);
  ASSERT_EQ(spanned.report.warnings.size(), 1U);
  EXPECT_EQ(spanned.report.warnings[0].code, WarningCode::loose_curve);
  EXPECT_NE(spanned.report.warnings[0].text.find("node 101"), std::string::npos) << spanned.report.warnings[0].text;
}

TEST(SpanLoops, LoopsCanBeChosen) {
  Curves curves;
  curves.add_grid(on_sphere, 2, 1);
  const SpannedCurves all = span_curves(curves.take());
  ASSERT_EQ(count(all, LoopState::spanned), 2);
  SpanOptions options;
  for (std::size_t l = 0; l < all.loops.size(); ++l) {
    if (all.loops[l].state == LoopState::spanned) options.loops = {static_cast<Index>(l)};
  }
  EXPECT_EQ(count(span_curves(curves.take(), options), LoopState::spanned), 1);
  options.without = std::exchange(options.loops, {});
  EXPECT_EQ(count(span_curves(curves.take(), options), LoopState::left_out), 1);
  options.without = {7};
  EXPECT_EQ(refusal([&] { (void)span_curves(curves.take(), options); }, ErrorCode::invalid_argument),
            "7 in without is no loop; loops go from 0 to 2");
}

TEST(SpanLoops, RefusesWhatItCannotDo) {
  Curves curves;
  curves.add_grid(on_sphere, 1, 1);
  const auto refused = [&](const SpanOptions& options) {
    return refusal([&] { (void)span_curves(curves.take(), options); }, ErrorCode::invalid_argument);
  };
  SpanOptions options;
  options.edge_length = 0;
  EXPECT_EQ(refused(options), "edge_length is 0, but has to be greater than 0");
  options.edge_length = 1e-6;
  EXPECT_EQ(refused(options).substr(0, 35), "edges of length 1e-06 ask for some ");
  options = {};
  options.join = -1;
  EXPECT_EQ(refused(options), "join is -1, but has to be 0 or more");
  options = {};
  options.sharp = {4};
  EXPECT_EQ(refused(options), "4 in sharp is no chain; chains go from 0 to 3");
  PolygonCurve broken = curves.take();
  std::vector<Vector3> places = broken.positions();
  places[3].x() = NAN;
  broken.set_positions(places);
  EXPECT_EQ(refusal([&] { (void)span_curves(broken); }, ErrorCode::unusable_shape),
            "node 3: its position is not finite");
  EXPECT_TRUE(
      says(refusal([&] { (void)span_curves(PolygonCurve()); }, ErrorCode::unusable_shape), "no curves make a loop"));
}

}  // namespace
}  // namespace vspring::span_loops_test
