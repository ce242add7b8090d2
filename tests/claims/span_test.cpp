// Surfaces that networks of curves define: known ones, lids, sharp curves, and what cannot be spanned.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::span_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

/// Curves that share no node: where they meet has to be found.
class Curves {
 public:
  void add(const std::function<Vector3(double)>& at, int nodes = 25) {
    PolygonCurve::Chain chain;
    for (int k = 0; k < nodes; ++k) {
      chain.nodes.push_back(static_cast<Index>(places_.size()));
      places_.push_back(at(static_cast<double>(k) / (nodes - 1)));
    }
    chains_.push_back(std::move(chain));
  }
  void add_line(const Vector3& a, const Vector3& b) {
    add([=](double t) { return Vector3(a + t * (b - a)); }, 2);
  }
  /// Lines of constant u and v of a surface.
  void add_grid(const std::function<Vector3(double, double)>& at, int nu, int nv, int nodes = 25) {
    for (int i = 0; i <= nu; ++i) add([&](double t) { return at(static_cast<double>(i) / nu, t); }, nodes);
    for (int j = 0; j <= nv; ++j) add([&](double t) { return at(t, static_cast<double>(j) / nv); }, nodes);
  }
  [[nodiscard]] PolygonCurve take() const { return {places_, chains_}; }

 private:
  std::vector<Vector3> places_;
  std::vector<PolygonCurve::Chain> chains_;
};

Vector3 on_sphere(double u, double v) {
  const double a = 1.6 * (u - 0.5);
  const double b = 1.6 * (v - 0.5);
  return {std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)};
}

Vector3 on_torus(double u, double v) {
  const double a = 0.9 * pi * u;
  const double b = 0.8 * pi * v + 0.3;
  return {(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)};
}

double from_unit_sphere(const std::vector<Vector3>& positions) {
  double most = 0;
  for (const Vector3& place : positions) most = std::max(most, std::abs(place.norm() - 1));
  return most;
}

double from_torus(const std::vector<Vector3>& positions) {
  double most = 0;
  for (const Vector3& place : positions)
    most = std::max(most, std::abs(std::hypot(std::hypot(place.x(), place.y()) - 3, place.z()) - 1));
  return most;
}

SpanOptions exact() {
  SpanOptions options;
  options.fair.method = EquilibriumMethod{.tolerance = 1e-9};
  return options;
}

Index count(const SpannedCurves& spanned, LoopState state) {
  return static_cast<Index>(std::ranges::count(spanned.loops, state, &NetworkLoop::state));
}

void expect_no_defects(const PolygonMesh& mesh) {
  for (const Defect& defect : check(mesh)) ADD_FAILURE() << defect.message();
}

double volume(const SpannedCurves& spanned) {
  double sum = 0;
  for (Index f = 0; f < spanned.mesh.face_count(); ++f) {
    const auto face = spanned.mesh.face(f);
    const auto at = [&](std::size_t k) { return spanned.positions[static_cast<std::size_t>(face[k])]; };
    for (std::size_t k = 1; k + 1 < face.size(); ++k) sum += at(0).dot(at(k).cross(at(k + 1))) / 6;
  }
  return sum;
}

/// Three great circles.
Curves octahedron() {
  Curves curves;
  for (int axis = 0; axis < 3; ++axis)
    curves.add(
        [=](double t) {
          Vector3 place = Vector3::Zero();
          place[axis] = std::cos(2 * pi * t);
          place[(axis + 1) % 3] = std::sin(2 * pi * t);
          return place;
        },
        49);
  return curves;
}

/// Meridians and parallels of a cylinder of radius 1.
Curves cylinder(int meridians, int parallels) {
  Curves curves;
  for (int k = 0; k < meridians; ++k) {
    const double a = 2 * pi * k / meridians;
    curves.add_line({std::cos(a), std::sin(a), 0}, {std::cos(a), std::sin(a), 3});
  }
  for (int k = 0; k < parallels; ++k)
    curves.add([=](double t) { return Vector3(std::cos(2 * pi * t), std::sin(2 * pi * t), 3.0 * k / (parallels - 1)); },
               49);
  return curves;
}

Curves cube() {
  Curves curves;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) {
      Vector3 from = Vector3::Zero();
      from[(axis + 1) % 3] = side % 2;
      from[(axis + 2) % 3] = side < 2 ? 0 : 1;
      Vector3 to = from;
      to[axis] = 1;
      curves.add_line(from, to);
    }
  }
  return curves;
}

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

TEST(Span, FacesLookOutwards) {
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

TEST(Span, LeavesTheEndsOfATubeOpen) {
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

TEST(Span, SpansLidsThatAreAskedForOrSharp) {
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

TEST(Span, SharpCurvesDoNotCloseASheet) {
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

TEST(Span, FacesOfACubeAreNoLids) {
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

TEST(Span, JoinsCurvesThatNearlyMeet) {
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

TEST(Span, WarnsOfCurvesThatBoundNothing) {
  Curves curves;
  curves.add_grid(on_sphere, 1, 1);
  curves.add_line(on_sphere(0, 0), {2, 2, 2});
  const SpannedCurves spanned = span_curves(curves.take());
  EXPECT_EQ(count(spanned, LoopState::spanned), 1);
  ASSERT_EQ(spanned.report.warnings.size(), 1U);
  EXPECT_EQ(spanned.report.warnings[0].code, WarningCode::loose_curve);
  EXPECT_NE(spanned.report.warnings[0].text.find("node 101"), std::string::npos) << spanned.report.warnings[0].text;
}

TEST(Span, LoopsCanBeChosen) {
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

TEST(Span, RefusesWhatItCannotDo) {
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
