// Surfaces that networks of curves define: known ones, sharp curves, symmetry, and what is said of them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/curve_networks.hpp"
#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::span_test {
namespace {

using namespace support;
using namespace support::networks;

TEST(Span, CurvesOfASphereGiveTheSphere) {
  Curves curves;
  curves.add_grid(on_sphere, 4, 3);
  const SpannedCurves spanned = span_curves(curves.take(), exact());
  EXPECT_TRUE(spanned.usable());
  EXPECT_EQ(spanned.loops.size(), 13U);
  EXPECT_EQ(count(spanned, LoopState::spanned), 12);
  EXPECT_EQ(count(spanned, LoopState::outer), 1);
  for (const NetworkLoop& loop : spanned.loops) EXPECT_EQ(loop.is_grid, loop.state == LoopState::spanned);
  expect_no_defects(spanned.mesh);
  // Cubics through 25 nodes on a circle leave it by some 1e-9.
  EXPECT_LT(from_unit_sphere(spanned.positions), 5e-9);
  EXPECT_GT(from_unit_sphere(spanned.mesh.positions()), 5e-4);  // Coons's patches
}

TEST(Span, CurvesWithoutEndsCloseABody) {
  const SpannedCurves spanned = span_curves(octahedron().take(), exact());
  EXPECT_TRUE(spanned.usable());
  EXPECT_EQ(spanned.curves.size(), 12U);
  EXPECT_EQ(count(spanned, LoopState::spanned), 8);
  EXPECT_TRUE(boundary_loops(spanned.mesh).empty());
  expect_no_defects(spanned.mesh);
  EXPECT_LT(from_unit_sphere(spanned.positions), 5e-9);
  EXPECT_NEAR(volume(spanned), 4 * pi / 3, 0.01);  // faces point outwards
}

TEST(Span, IsMuchNearerToATorusThanCoonsPatches) {
  Curves curves;
  curves.add_grid(on_torus, 4, 3);
  const SpannedCurves spanned = span_curves(curves.take(), exact());
  EXPECT_TRUE(spanned.usable());
  EXPECT_LT(from_torus(spanned.positions), from_torus(spanned.mesh.positions()) / 50);
}

TEST(Span, ANetTwiceAsFineIsSevenTimesNearer) {
  std::vector<double> errors;
  for (const int n : {2, 4}) {
    Curves curves;
    curves.add_grid(on_torus, n, n);
    SpanOptions options = exact();
    options.edge_length = 0.06;
    errors.push_back(from_torus(span_curves(curves.take(), options).positions));
  }
  EXPECT_LT(errors[1], errors[0] / 7);
}

TEST(Span, KeepsTheNodesOnCurvesAndTheNormalsWhereItEnds) {
  Curves curves;
  curves.add_grid(on_sphere, 2, 2);
  const SpannedCurves spanned = span_curves(curves.take(), exact());
  const auto at_end = boundary_nodes(spanned.mesh);
  for (const NetworkCurve& curve : spanned.curves) {
    ASSERT_FALSE(curve.nodes.empty());
    for (const Index node : curve.nodes) {
      EXPECT_TRUE(spanned.constraints.position_fixed(node));
      EXPECT_EQ(spanned.positions[static_cast<std::size_t>(node)], spanned.mesh.position(node));
      EXPECT_EQ(spanned.constraints.normal_fixed(node), at_end[static_cast<std::size_t>(node)] != 0) << node;
      if (spanned.constraints.normal_fixed(node)) {
        EXPECT_GT(std::abs(spanned.constraints.normal(node).dot(spanned.mesh.position(node))), 1 - 1e-5);
      }
    }
  }
}

TEST(Span, ASharpCurveSeparatesTwoCylinders) {
  // A roof of two arcs that meet in a ridge at x = 0.
  const auto side = [](double t, double sign) {
    return Vector3(sign * (std::sin(0.9) - std::sin(0.9 * t)), 0, std::cos(0.9 * t) - std::cos(0.9));
  };
  Curves curves;
  for (const double y : {0.0, 1.0, 2.0}) {
    for (const double sign : {-1.0, 1.0})
      curves.add([&](double t) { return Vector3(side(1 - t, sign) + Vector3(0, y, 0)); });
  }
  for (const double sign : {-1.0, 1.0}) curves.add_line(side(0, sign), side(0, sign) + Vector3(0, 2, 0));
  curves.add_line(Vector3::Zero(), {0, 2, 0});
  SpanOptions options = exact();
  options.sharp = {8};
  const SpannedCurves spanned = span_curves(curves.take(), options);
  EXPECT_TRUE(spanned.usable());
  EXPECT_EQ(count(spanned, LoopState::spanned), 4);
  for (const Vector3& place : spanned.positions) {
    const double x = std::abs(place.x());
    EXPECT_LT(std::abs(std::hypot(x - std::sin(0.9), place.z() + std::cos(0.9)) - 1), 1e-7);
  }
  const std::string text = surface_bytes("roof.obj", file_of(spanned), spanned.positions).bytes;
  const SurfaceFile read = read_surface_bytes(text, "roof.obj");
  EXPECT_EQ(read.groups.size(), 4U);
  MeshEdges marks = marked_edges(read);
  for (auto& [a, b] : marks) std::tie(a, b) = std::minmax({a, b});
  std::sort(marks.begin(), marks.end());
  EXPECT_EQ(marks, spanned.sharp_edges);
}

TEST(Span, EndsAtRightAnglesToAPlaneOfSymmetry) {
  // Half a sphere whose meridians arrive at the plane at 75°.
  Curves curves;
  curves.add_grid(
      [](double u, double v) { return Vector3(on_sphere(u, 0.5 + v / 3) - Vector3(0.3 * v * (1 - v), 0, 0)); }, 4, 2);
  const auto steepest = [](const SpannedCurves& spanned) {
    double most = 0;
    for (Index node = 0; node < spanned.mesh.node_count(); ++node) {
      if (std::abs(spanned.mesh.position(node).z()) < 1e-12)
        most = std::max(most, std::abs(spanned.constraints.normal(node).z()));
    }
    return most;
  };
  SpanOptions options = exact();
  EXPECT_GT(steepest(span_curves(curves.take(), options)), 0.2);
  options.symmetry = parse_plane("z");
  const SpannedCurves symmetric = span_curves(curves.take(), options);
  EXPECT_TRUE(symmetric.usable());
  EXPECT_GT(symmetric.symmetric_nodes, 20);
  EXPECT_LT(steepest(symmetric), 1e-12);
}

TEST(Span, ACircleInAPlaneOfSymmetryIsTheRimOfHalfASphere) {
  Curves curves;
  curves.add([](double t) { return Vector3(std::cos(2 * pi * t), std::sin(2 * pi * t), 0); }, 49);
  SpanOptions options = exact();
  const SpannedCurves flat = span_curves(curves.take(), options);
  EXPECT_TRUE(flat.usable());
  for (const Vector3& place : flat.positions) EXPECT_LT(std::abs(place.z()), 1e-9);
  options.symmetry = parse_plane("z");
  const SpannedCurves dome = span_curves(curves.take(), options);
  EXPECT_TRUE(dome.usable());
  EXPECT_LT(from_unit_sphere(dome.positions), 1e-7);
}

TEST(Span, LoopsOfThreeAndFiveSidesHaveTriangles) {
  // A pentagon around the pole of a sphere, divided into a quad and a triangle by one of its diagonals.
  const auto corner = [](int k) { return 2 * pi * k / 5; };
  const auto arc = [&](int from, int to) {
    const Vector3 a =
        Vector3(std::sin(0.6) * std::cos(corner(from)), std::sin(0.6) * std::sin(corner(from)), std::cos(0.6));
    const Vector3 b =
        Vector3(std::sin(0.6) * std::cos(corner(to)), std::sin(0.6) * std::sin(corner(to)), std::cos(0.6));
    return [=](double t) { return Vector3(((1 - t) * a + t * b).normalized()); };
  };
  Curves curves;
  for (int k = 0; k < 5; ++k) curves.add(arc(k, k + 1));
  const SpannedCurves five = span_curves(curves.take(), exact());
  ASSERT_EQ(five.loops.size(), 1U);
  EXPECT_FALSE(five.loops[0].is_grid);
  EXPECT_TRUE(five.usable());
  curves.add(arc(0, 2));
  const SpannedCurves divided = span_curves(curves.take(), exact());
  EXPECT_EQ(count(divided, LoopState::spanned), 2);
  expect_no_defects(divided.mesh);
  EXPECT_LT(from_unit_sphere(divided.positions), 2e-3);
  EXPECT_LT(from_unit_sphere(divided.positions), from_unit_sphere(divided.mesh.positions()) / 20);
}

TEST(Span, FairsTheCurvesFirstIfAsked) {
  // Curves of a sphere with waves that begin and end at their junctions.
  Curves curves;
  const auto waved = [](double u, double v) {
    return Vector3((1 + 0.01 * (2 - std::cos(8 * pi * u) - std::cos(8 * pi * v))) * on_sphere(u, v));
  };
  curves.add_grid(waved, 4, 4, 97);
  SpanOptions options = exact();
  const double held = from_unit_sphere(span_curves(curves.take(), options).positions);
  options.fair_curves = true;
  const double faired = from_unit_sphere(span_curves(curves.take(), options).positions);
  EXPECT_GT(held, 0.019);
  EXPECT_LT(faired, held / 10);
}

TEST(Span, AHelicoidMayTurnAsFarAsItWill) {
  // Only its two ends tell normals, which turn by 270 degrees between.
  const auto on_helicoid = [](double r, double t) {
    const double angle = 1.5 * pi * t;
    return Vector3(r * std::cos(angle), r * std::sin(angle), 0.4 * angle);
  };
  Curves curves;
  for (const double r : {0.5, 1.0}) curves.add([&](double t) { return on_helicoid(r, t); }, 81);
  for (const double t : {0.0, 1.0}) curves.add_line(on_helicoid(0.5, t), on_helicoid(1, t));
  const SpannedCurves spanned = span_curves(curves.take(), exact());
  EXPECT_TRUE(spanned.usable());
  for (const Vector3& place : spanned.positions) {
    const double angle = place.z() / 0.4;
    EXPECT_NEAR(place.x() * std::sin(angle), place.y() * std::cos(angle), 5e-3);
  }
}

TEST(Span, SaysWhatBecameOfCurvesThatAreFairedFirst) {
  // Each circle is held where the one profile meets it.
  SpanOptions options = exact();
  options.fair_curves = true;
  const SpannedCurves spanned = span_curves(cylinder(1, 3).take(), options);
  const auto& warnings = spanned.report.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
    return warning.code == WarningCode::family_of_shapes &&
           warning.text.starts_with("the curve at node 0 was faired by itself with the warning family-of-shapes");
  }));
}

TEST(Span, IsNoAnswerWhereCurvesThatAreToBeFairedAreNot) {
  // In a plane the surface is fair at once, but its curves are not.
  Curves curves;
  curves.add_grid([](double u, double v) { return Vector3(u + 0.05 * std::sin(pi * u) * v, v, 0); }, 1, 1);
  curves.add([](double t) { return Vector3(t, 0.5 + 0.1 * std::sin(2 * pi * t), 0); }, 49);
  SpanOptions options;
  options.fair.method = EquilibriumMethod{.max_iterations = 1};
  EXPECT_TRUE(span_curves(curves.take(), options).usable());
  options.fair_curves = true;
  const SpannedCurves spanned = span_curves(curves.take(), options);
  EXPECT_FALSE(spanned.usable());
  EXPECT_EQ(spanned.report.outcome, Outcome::iteration_limit);
}

TEST(Span, WarnsOfASurfaceThatCrossesItself) {
  Curves knot;
  knot.add(
      [](double t) {
        const double a = 2 * pi * t;
        return Vector3(std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a), -std::sin(3 * a));
      },
      97);
  const SpannedCurves spanned = span_curves(knot.take());
  ASSERT_EQ(count(spanned, LoopState::spanned), 1);
  const auto& warnings = spanned.report.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(),
                          [](const Warning& warning) { return warning.code == WarningCode::patch_crosses; }));
}

TEST(Span, HasTheSameBitsOnAnyNumberOfThreadsAndWhenRepeated) {
  Curves curves;
  curves.add_grid(on_torus, 3, 3);
  std::vector<std::vector<Vector3>> results;
  for (const int threads : {1, 2, 5}) {
    Context context;
    context.threads = threads;
    results.push_back(span_curves(curves.take(), {}, context).positions);
  }
  for (const auto& result : results)
    EXPECT_EQ(std::memcmp(result.data(), results[0].data(), result.size() * sizeof(Vector3)), 0);
}

TEST(Span, EndsSoonWhenCancelled) {
  Context context;
  context.cancel();
  const SpannedCurves spanned = span_curves(octahedron().take(), {}, context);
  EXPECT_EQ(spanned.report.outcome, Outcome::cancelled);
  EXPECT_EQ(count(spanned, LoopState::cancelled), 8);
  EXPECT_EQ(spanned.mesh.face_count(), 0);
}

}  // namespace
}  // namespace vspring::span_test
