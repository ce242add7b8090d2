// Half a shape by symmetry is half of what the whole comes to; a whole one comes out as its own mirror image, to the
// bit; what is not symmetric is refused, by the number of its node.

#include "support/symmetry.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/refusal.hpp"
#include "support/specimens.hpp"

namespace vspring::symmetry_test {
namespace {

using namespace support;
using generate::Faces;

FairOptions to_the_end() {
  FairOptions options;
  options.method = EquilibriumMethod{.tolerance = 1e-12};
  return options;
}

class SymmetryOfFaces : public testing::TestWithParam<Faces> {};

TEST_P(SymmetryOfFaces, HalfASphereIsTheSphere) {
  const PolygonMesh exact = sphere_part(GetParam(), true);
  const Constraints rim = held_rim(find_symmetry(exact, x_is_0));
  const PolygonMesh start = disturbed(exact, rim, 0.02, x_is_0);
  const Symmetric<PolygonMesh> shape = find_symmetry(start, x_is_0);
  EXPECT_TRUE(shape.is_half);
  const FairResult result = fair(shape, rim, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
  EXPECT_GT(result.report.greatest_move, 0.01);
  for (Index i = 0; i < start.node_count(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (shape.partner[node] == i) {
      EXPECT_EQ(result.positions[node].x(), 0) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SymmetryOfFaces, testing::ValuesIn(every_kind),
                         [](const auto& info) { return name_of(info.param); });

/// A sheet over a square, wavy at its rim and rough within, in which x and −x are alike.
PolygonMesh sheet() {
  const PolygonMesh flat = generate::plane({.columns = 16, .rows = 12, .faces = Faces::quads}, 2, 1.5);
  const std::vector<std::uint8_t> boundary = boundary_nodes(flat);
  std::vector<Vector3> positions = flat.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double x = std::abs(positions[i].x() - 1) < 1e-12 ? 0 : positions[i].x() - 1;
    const double y = positions[i].y();
    const double rough = boundary[i] != 0 ? 0 : 0.1 * std::sin(40 * std::abs(x) + 17 * y);
    positions[i] = Vector3(x, y, 0.3 * x * x + 0.2 * std::sin(3 * y) * std::cos(2 * x) + rough);
  }
  return with_positions(flat, std::move(positions));
}

struct Part {
  PolygonMesh mesh;
  std::vector<Index> node;  ///< of the whole
};

/// The faces on the side of the plane's normal.
Part half_of(const PolygonMesh& mesh, const MirrorPlane& plane) {
  Part part;
  MeshBuilder builder;
  std::vector<Index> number(static_cast<std::size_t>(mesh.node_count()), -1);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::any_of(face.begin(), face.end(), [&](Index i) { return plane.distance(mesh.position(i)) < -1e-9; }))
      continue;
    std::vector<Index> nodes;
    for (const Index i : face) {
      Index& at = number[static_cast<std::size_t>(i)];
      if (at < 0) {
        at = builder.add_node(mesh.position(i));
        part.node.push_back(i);
      }
      nodes.push_back(at);
    }
    builder.add_face(nodes);
  }
  part.mesh = builder.take();
  return part;
}

TEST(Symmetry, HalfIsFairedAsTheWhole) {
  const PolygonMesh whole = sheet();
  const FairResult of_whole = fair(whole, clamped_boundary(whole), to_the_end());
  const Part half = half_of(whole, x_is_0);
  const Symmetric<PolygonMesh> shape = find_symmetry(half.mesh, x_is_0);
  const FairResult of_half = fair(shape, clamped_boundary(shape.whole), to_the_end());
  for (std::size_t i = 0; i < half.node.size(); ++i)
    EXPECT_LT((of_half.positions[i] - of_whole.positions[static_cast<std::size_t>(half.node[i])]).norm(), 1e-10) << i;
  // Without symmetry the edge in the plane stays as rough as it was.
  const FairResult alone = fair(half.mesh, clamped_boundary(half.mesh), to_the_end());
  EXPECT_GT(greatest_distance(alone.positions, of_half.positions), 0.05);
}

TEST(Symmetry, ReportIsOfTheHalf) {
  const PolygonMesh mesh = half_of(sheet(), x_is_0).mesh;
  const Symmetric<PolygonMesh> shape = find_symmetry(mesh, x_is_0);
  EXPECT_EQ(shape.on_plane, 13);
  EXPECT_EQ(shape.pairs, 8 * 13);
  const FairReport report = fair(shape, clamped_boundary(shape.whole)).report;
  EXPECT_EQ(report.nodes, 9 * 13);
  EXPECT_EQ(report.faces, 8 * 12);
  // The rim without the edge in the plane, but with its ends.
  EXPECT_EQ(report.fixed_positions, 8 + 9 + 8 + 4);
  EXPECT_EQ(report.fixed_normals, report.fixed_positions);
  EXPECT_EQ(report.moving_nodes, 8 * 11);
}

TEST(Symmetry, NodesOnThePlaneSlideInItAndMoveAsFarAsReported) {
  const PolygonMesh mesh = half_of(sheet(), x_is_0).mesh;
  const Symmetric<PolygonMesh> shape = find_symmetry(mesh, x_is_0);
  const FairResult result = fair(shape, clamped_boundary(shape.whole));
  const Distance moves = node_distance(mesh.positions(), result.positions);
  EXPECT_EQ(result.report.greatest_move, moves.greatest);
  EXPECT_NEAR(result.report.rms_move, moves.rms * std::sqrt(117.0 / 88), 1e-12);
  double slid = 0;
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    if (shape.partner[i] != static_cast<Index>(i)) continue;
    EXPECT_EQ(result.positions[i].x(), 0);
    slid = std::max(slid, (result.positions[i] - mesh.positions()[i]).norm());
  }
  EXPECT_GT(slid, 0.05);
}

TEST(Symmetry, WholeComesOutSymmetricToTheBit) {
  for (const Faces faces : {Faces::quads, Faces::triangles}) {
    const PolygonMesh exact = sphere_part(faces, false);
    const Constraints rim = held_boundary(exact, radial);
    const PolygonMesh start = generate::add_noise(exact, 0.01, 7);
    const Symmetric<PolygonMesh> shape = find_symmetry(start, x_is_0);
    EXPECT_FALSE(shape.is_half);
    EXPECT_EQ(shape.on_plane, 21);
    const FairResult result = fair(shape, rim, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.nodes, exact.node_count());
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
    expect_mirror_images(shape, result.positions);
  }
}

TEST(Symmetry, ARidgeInThePlaneStaysSharp) {
  PolygonMesh roof = half_of(generate::plane({.columns = 12, .rows = 12}, 2, 2), parse_plane("x=1")).mesh;
  std::vector<Vector3> tilted;
  for (const Vector3& p : roof.positions()) tilted.emplace_back(p.x() - 1, p.y(), std::abs(p.x() - 1));
  roof.set_positions(tilted);
  const Symmetric<PolygonMesh> exact = find_symmetry(roof, x_is_0);
  FairOptions options = to_the_end();
  options.sharp_edges = find_sharp_edges(exact.whole, 60).edges;
  options.sharp_curves = SharpCurves::fit;
  ASSERT_EQ(options.sharp_edges.size(), 12U);
  const Constraints held = held_boundary(exact.whole);
  const FairResult result = fair(find_symmetry(disturbed(roof, held, 0.02, x_is_0), x_is_0), held, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  for (const Vector3& p : result.positions) EXPECT_NEAR(p.z(), std::abs(p.x()), 1e-9);
}

TEST(Symmetry, PlaneMayLieAnywhere) {
  const Motion motion;
  const MirrorPlane plane = {.point = motion.point(Vector3::Zero()), .normal = motion.turn * Vector3::UnitX()};
  const PolygonMesh straight = half_of(sheet(), x_is_0).mesh;
  const Symmetric<PolygonMesh> shape = find_symmetry(straight, x_is_0);
  const PolygonMesh turned = with_positions(straight, motion.points(straight.positions()));
  const Symmetric<PolygonMesh> turned_shape = find_symmetry(turned, plane);
  const FairResult there = fair(turned_shape, clamped_boundary(turned_shape.whole), to_the_end());
  const FairResult here = fair(shape, clamped_boundary(shape.whole), to_the_end());
  EXPECT_LT(greatest_distance(there.positions, motion.points(here.positions)) / motion.scale, 1e-10);
}

TEST(Symmetry, RegionOfAHalfMovesAloneAndMeetsTheRest) {
  const PolygonMesh exact = sphere_part(Faces::mixed, true);
  std::vector<Index> region;
  Constraints inside(exact.node_count());
  for (Index i = 0; i < exact.node_count(); ++i) {
    if ((exact.position(i) - Vector3(0, 0.8, 0.6)).norm() < 0.4)
      region.push_back(i);
    else
      inside.fix_position(i, exact.position(i));
  }
  const PolygonMesh start = disturbed(exact, inside, 0.02, x_is_0);
  const Symmetric<PolygonMesh> shape = find_symmetry(start, x_is_0);
  Constraints constraints(shape.whole.node_count());
  std::vector<Index> of_whole = region;
  for (const Index i : region) of_whole.push_back(shape.partner[static_cast<std::size_t>(i)]);
  restrict_to_region(constraints, shape.whole, of_whole);
  const FairResult result = fair(shape, constraints, to_the_end());
  EXPECT_EQ(result.report.moving_nodes, static_cast<Index>(region.size()));
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
  for (Index i = 0; i < exact.node_count(); ++i) {
    if (std::find(region.begin(), region.end(), i) == region.end()) {
      EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], start.position(i)) << i;
    }
  }
}

TEST(Symmetry, HalfACircleIsTheCircle) {
  // Both ends on the plane, one of them, and the other: the curve is a closed one, or a longer open one.
  const MirrorPlane y_is_0 = parse_plane("y");
  const struct {
    PolygonCurve half;
    bool closed;
  } cases[] = {{arc(0, 180, 0.02), true}, {arc(0, 120, 0.02), false}, {arc(70, 180, 0.02), false}};
  for (const auto& [half, closed] : cases) {
    const Symmetric<PolygonCurve> shape = find_symmetry(half, y_is_0);
    EXPECT_TRUE(shape.is_half);
    ASSERT_EQ(shape.whole.chains().size(), 1U);
    EXPECT_EQ(shape.whole.chains()[0].closed, closed);
    Constraints constraints(half.node_count());
    if (closed)
      for (const Index i : {0, 13, 40}) constraints.fix_position(i, half.position(i).normalized());
    else
      hold_on_circle(constraints, half, half.position(0).y() > 0.5 ? 0 : 40);
    const FairResult result = fair(shape, constraints, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_circle(result.positions), 1e-10);
    EXPECT_EQ(result.report.nodes, 41);
    EXPECT_EQ(result.report.fixed_positions, closed ? 3 : 1);
    EXPECT_EQ(result.report.moving_nodes, closed ? 38 : 40);
    EXPECT_EQ(result.report.fixed_tangents, closed ? 0 : 1);
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
      if (shape.partner[i] == static_cast<Index>(i)) {
        EXPECT_EQ(result.positions[i].y(), 0);
      }
    }
  }
}

TEST(Symmetry, TangentsAndCornersAreMirrored) {
  // An arc of the unit circle about (0.5, 0), so the curve has a corner on the plane x = 0.
  PolygonCurve half = arc(120, 30, 0.01);
  std::vector<Vector3> nodes = half.positions();
  for (Vector3& node : nodes) node.x() += 0.5;
  half.set_positions(nodes);
  const Symmetric<PolygonCurve> shape = find_symmetry(half, x_is_0);
  Constraints constraints(half.node_count());
  const auto along = [](double angle) {
    return Vector3(std::sin(angle * std::numbers::pi / 180), -std::cos(angle * std::numbers::pi / 180), 0);
  };
  constraints.fix_position(0, half.position(0));
  constraints.make_corner(0);
  constraints.fix_tangent(0, along(120), NodeSide::after);
  constraints.fix_position(40, half.position(40));
  constraints.fix_tangent(40, along(30));
  const Constraints both = symmetric_constraints(shape, constraints);
  const Index image = shape.partner[40];
  EXPECT_LT((both.tangent(image) - Vector3(along(30).x(), -along(30).y(), 0)).norm(), 1e-15);
  ASSERT_TRUE(both.tangent_fixed(0, NodeSide::before));
  EXPECT_LT((both.tangent(0, NodeSide::before) - Vector3(along(120).x(), -along(120).y(), 0)).norm(), 1e-15);
  const FairResult result = fair(shape, constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.corners, 1);
  for (const Vector3& node : result.positions) EXPECT_NEAR((node - Vector3(0.5, 0, 0)).norm(), 1, 1e-10);
}

TEST(Symmetry, WholeCurveComesOutSymmetricToTheBit) {
  const MirrorPlane y_is_0 = parse_plane("y");
  const PolygonCurve curve = arc(-130, 130, 0.03);
  const Symmetric<PolygonCurve> shape = find_symmetry(curve, y_is_0);
  EXPECT_FALSE(shape.is_half);
  Constraints constraints(curve.node_count());
  for (const Index i : {0, 40}) hold_on_circle(constraints, curve, i);
  const FairResult faired = fair(shape, constraints, to_the_end());
  EXPECT_LT(distance_from_circle(faired.positions), 1e-10);
  expect_mirror_images(shape, faired.positions);
}

TEST(Symmetry, AHalfThatGoesThroughThePlaneIsNoAnswer) {
  // Held above the plane, where the tangent leads down through it.
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 20; ++k) nodes.emplace_back(0.05 * k, 0.2 * (1 - 0.05 * k), 0);
  const PolygonCurve half(nodes);
  const Symmetric<PolygonCurve> shape = find_symmetry(half, parse_plane("y"));
  Constraints constraints(half.node_count());
  constraints.fix_position(0, half.position(0));
  constraints.fix_position(20, half.position(20));
  constraints.fix_tangent(0, {-1, -1, 0});
  FairOptions options = to_the_end();
  const FairReport report = fair(shape, constraints, options).report;
  EXPECT_EQ(report.outcome, Outcome::worse_than_input);
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_EQ(report.warnings.back().code, WarningCode::worse_than_input);
  EXPECT_TRUE(says(report.warnings.back().text, "the shape goes through the plane y = 0"))
      << report.warnings.back().text;
  options.accept_worse = true;
  const FairResult accepted = fair(shape, constraints, options);
  EXPECT_EQ(accepted.report.outcome, Outcome::converged);
  ASSERT_LT(accepted.positions[6].y(), -0.05);
  // Who holds a node there wants it there.
  options.accept_worse = false;
  constraints.fix_position(6, accepted.positions[6]);
  EXPECT_EQ(fair(shape, constraints, options).report.outcome, Outcome::converged);
}

TEST(Symmetry, PlanesAreReadFromText) {
  EXPECT_EQ(parse_plane("z").normal, Vector3::UnitZ());
  EXPECT_EQ(parse_plane("y=2.5").point, Vector3(0, 2.5, 0));
  const MirrorPlane plane = parse_plane("plane:1,2,3,0,3,4");
  EXPECT_EQ(plane.point, Vector3(1, 2, 3));
  EXPECT_LT((plane.normal - Vector3(0, 0.6, 0.8)).norm(), 1e-15);
  for (const char* text : {"", "w", "x=", "x=a", "x=1,", "xy", "plane:", "plane:1,2,3", "plane:1,2,3,0,0,0",
                           "plane:1,2,3,0,0,nan", "sphere:0,0,0,1"}) {
    const std::string message = refusal([&] { (void)parse_plane(text); }, ErrorCode::unusable_constraint);
    EXPECT_TRUE(says(message, fmt::format("plane \"{}\"", text))) << message;
    EXPECT_TRUE(says(message, "plane:px,py,pz,nx,ny,nz")) << message;
  }
}

std::string refused_shape(const PolygonMesh& mesh, const MirrorPlane& plane) {
  return refusal([&] { (void)find_symmetry(mesh, plane); }, ErrorCode::unusable_shape);
}

PolygonMesh with_node_at(const PolygonMesh& mesh, Index node, const Vector3& place) {
  std::vector<Vector3> positions = mesh.positions();
  positions[static_cast<std::size_t>(node)] = place;
  return with_positions(mesh, std::move(positions));
}

TEST(Symmetry, ShapesThatAreNotSymmetricAreRefusedByNode) {
  const PolygonMesh half = sphere_part(Faces::quads, true);
  const PolygonMesh whole = sphere_part(Faces::quads, false);
  EXPECT_TRUE(says(refused_shape(half, parse_plane("x=-2")), "the plane x = -2 misses the shape: node 0"));
  EXPECT_TRUE(says(refused_shape(half, parse_plane("z=0.9")), "beyond the plane z = 0.9"));
  // The second node of a row that begins on the plane.
  EXPECT_TRUE(says(refused_shape(with_node_at(half, 56, {-0.1, 0.7, 0.7}), x_is_0), "node 56 lies 0.1 beyond"));
  EXPECT_TRUE(says(refused_shape(with_node_at(half, 56, {0, 0.7, 0.7}), x_is_0),
                   "the edge between nodes 55 and 56 lies in the plane x = 0"));
  EXPECT_TRUE(says(refused_shape(with_node_at(half, 60, {0, 0.7, 0.7}), x_is_0),
                   "node 60 lies in the plane x = 0, but no boundary edge"));
  EXPECT_TRUE(says(refused_shape(with_node_at(half, 60, {NAN, 0.7, 0.7}), x_is_0), "node 60: a coordinate"));
  EXPECT_TRUE(says(refused_shape(generate::plane(), parse_plane("z")), "all of the shape lies in the plane z = 0"));
  EXPECT_TRUE(says(refused_shape(with_node_at(whole, 30, {0.3, 0.3, 2}), x_is_0), "node 30 has no mirror image"));
  EXPECT_TRUE(says(refused_shape(whole, parse_plane("y=0.5")), "node"));
  // Cut along diagonals that are not mirror images.
  const PolygonMesh cut({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 3, 6, 9, 12},
                        {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4});
  EXPECT_TRUE(says(refused_shape(cut, x_is_0), "face 0 has no mirror image"));
  const auto refused_curve = [](const PolygonCurve& curve) {
    return refusal([&] { (void)find_symmetry(curve, parse_plane("y")); }, ErrorCode::unusable_shape);
  };
  PolygonCurve touching = arc(0, 120, 0);
  std::vector<Vector3> nodes = touching.positions();
  nodes[20].y() = 0;
  touching.set_positions(nodes);
  EXPECT_TRUE(says(refused_curve(touching), "node 20 lies in the plane y = 0, but inside the curve"));
  EXPECT_TRUE(says(refused_curve(arc(-100, 60, 0)), "node 0"));
  EXPECT_TRUE(
      says(refusal([&] { (void)find_symmetry(half, {.normal = Vector3(2, 0, 0)}); }, ErrorCode::invalid_argument),
           "length 1"));
}

TEST(Symmetry, NodesAtOnePlaceAreToBeWelded) {
  // A strip across the plane, cut in two along its middle line.
  MeshBuilder builder;
  for (const double y : {0.0, 1.0, 1.0, 2.0}) {
    for (const double x : {-1.0, 0.0, 1.0}) builder.add_node({x, y, 0});
  }
  for (const Index row : {0, 6}) {
    for (const Index k : {row, row + 1}) builder.add_face({k, k + 1, k + 4, k + 3});
  }
  try {
    (void)find_symmetry(builder.take(), {.normal = {1, 0, 0}});
    ADD_FAILURE() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_TRUE(says(error.what(), "nodes 3 and 6 are at the same place")) << error.what();
    ASSERT_EQ(error.advice().size(), 1U);
    EXPECT_EQ(error.advice()[0].remedy, Remedy::weld);
  }
}

TEST(Symmetry, ConstraintsThatAreNotSymmetricAreRefusedByNode) {
  const PolygonMesh mesh = sphere_part(Faces::quads, false);
  const Symmetric<PolygonMesh> shape = find_symmetry(mesh, x_is_0);
  const auto refused = [&](const std::function<void(Constraints&)>& change) {
    Constraints constraints = held_rim(shape);
    change(constraints);
    return refusal([&] { (void)fair(shape, constraints); }, ErrorCode::unusable_constraint);
  };
  // Rows have 21 nodes; the plane is at the eleventh.
  EXPECT_TRUE(says(refused([&](Constraints& held) { held.fix_position(43, mesh.position(43)); }),
                   "node 43 has its position held, and its mirror image in the plane x = 0, node 61, has not"));
  EXPECT_TRUE(says(refused([&](Constraints& held) {
                     held.fix_normal(61, {0, 0, 1});
                   }),
                   "node 61 has its normal given, and its mirror image in the plane x = 0, node 43, has not"));
  EXPECT_TRUE(says(refused([&](Constraints& held) { held.fix_position(20, mesh.position(20) + Vector3(0, 0, 0.01)); }),
                   "nodes 0 and 20 are mirror images in the plane x = 0, but are held at places that are not: 0.01"));
  EXPECT_TRUE(says(refused([&](Constraints& held) {
                     held.fix_normal(20, {0, 0, 1});
                   }),
                   "nodes 0 and 20 are mirror images in the plane x = 0, but their normals are not"));
  EXPECT_TRUE(says(refused([&](Constraints& held) {
                     held.fix_normal(52, {1, 0, 1});
                   }),
                   "node 52 lies in the plane x = 0, but its normal does not"));
  EXPECT_TRUE(says(refused([&](Constraints& held) { held.fix_position(52, Vector3(0.01, 0.3, 1)); }),
                   "node 52 lies in the plane x = 0, but is held 0.01 away from it"));
  EXPECT_TRUE(says(refusal([&] { (void)fair(shape, Constraints(5)); }, ErrorCode::invalid_argument), "5 nodes"));
}

TEST(Symmetry, MessagesNameGivenNodes) {
  // The mirror images are nodes from 117 on.
  const PolygonMesh mesh = half_of(sheet(), x_is_0).mesh;
  const Symmetric<PolygonMesh> shape = find_symmetry(mesh, x_is_0);
  Constraints constraints = held_boundary(shape.whole);
  constraints.free_position(8);
  const FairResult result = fair(shape, constraints);
  ASSERT_FALSE(result.report.warnings.empty());
  EXPECT_EQ(result.report.warnings.front().code, WarningCode::free_boundary);
  EXPECT_TRUE(says(result.report.warnings.front().text, "together with the mirror image: 2 boundary nodes are free"))
      << result.report.warnings.front().text;
  EXPECT_TRUE(says(result.report.warnings.front().text, "node 8 first")) << result.report.warnings.front().text;
  const std::vector<Advice> advice = {{Remedy::fix_boundary, "fix the boundary to hold them"}};
  EXPECT_EQ(result.report.warnings.front().advice, advice);
}

}  // namespace
}  // namespace vspring::symmetry_test
