// Meshes of which the moving part is refined.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::refine_test {
namespace {

using namespace support;

using Edges = std::map<std::pair<Index, Index>, int>;

/// How many faces each edge has.
Edges edges_of(const PolygonMesh& mesh) {
  Edges edges;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) ++edges[std::minmax(face[k], face[(k + 1) % face.size()])];
  }
  return edges;
}

double length_of(const PolygonMesh& mesh, const std::pair<Index, Index>& edge) {
  return (mesh.position(edge.first) - mesh.position(edge.second)).norm();
}

Index euler_characteristic(const PolygonMesh& mesh) {
  return mesh.node_count() - static_cast<Index>(edges_of(mesh).size()) + mesh.face_count();
}

/// The length of the longest edge with a node that moves.
double longest_moving(const Refined& refined) {
  double longest = 0;
  for (const auto& [edge, faces] : edges_of(refined.mesh)) {
    if (refined.constraints.position_fixed(edge.first) && refined.constraints.position_fixed(edge.second)) continue;
    longest = std::max(longest, length_of(refined.mesh, edge));
  }
  return longest;
}

Vector3 vector_area(const PolygonMesh& mesh, Index f) {
  const auto face = mesh.face(f);
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 2; k < face.size(); ++k)
    sum += (mesh.position(face[k - 1]) - mesh.position(face[0])).cross(mesh.position(face[k]) - mesh.position(face[0]));
  return sum / 2;
}

/// What holds for every refinement: nodes of the input stay to the bit, as do faces that do not move; the surface is
/// the same, with no node within an edge, and nothing folds.
void expect_sound(const PolygonMesh& input, const Constraints& constraints, const Refined& refined) {
  ASSERT_EQ(refined.input_node_count(), input.node_count());
  ASSERT_EQ(refined.constraints.node_count(), refined.mesh.node_count());
  EXPECT_EQ(std::memcmp(refined.mesh.positions().data(), input.positions().data(),
                        input.positions().size() * sizeof(Vector3)),
            0);
  for (Index i = 0; i < input.node_count(); ++i)
    EXPECT_EQ(refined.constraints.position_fixed(i), constraints.position_fixed(i));
  EXPECT_EQ(euler_characteristic(refined.mesh), euler_characteristic(input));
  EXPECT_EQ(boundary_loops(refined.mesh).size(), boundary_loops(input).size());
  for (const Defect& defect : check(refined.mesh)) ADD_FAILURE() << defect.message();

  std::vector<double> area(static_cast<std::size_t>(input.face_count()), 0);
  ASSERT_EQ(refined.face_from.size(), static_cast<std::size_t>(refined.mesh.face_count()));
  EXPECT_TRUE(std::is_sorted(refined.face_from.begin(), refined.face_from.end()));
  for (Index f = 0; f < refined.mesh.face_count(); ++f) {
    const Index from = refined.face_from[static_cast<std::size_t>(f)];
    const Vector3 part = vector_area(refined.mesh, f);
    EXPECT_GT(part.dot(vector_area(input, from)), 0) << "face " << f << " of " << from;
    area[static_cast<std::size_t>(from)] += part.dot(vector_area(input, from).normalized());
  }
  for (Index f = 0; f < input.face_count(); ++f)
    EXPECT_NEAR(area[static_cast<std::size_t>(f)] / vector_area(input, f).norm(), 1, 1e-9);

  std::multiset<std::vector<Index>> faces;
  for (Index f = 0; f < refined.mesh.face_count(); ++f)
    faces.emplace(refined.mesh.face(f).begin(), refined.mesh.face(f).end());
  const std::vector<std::uint8_t> boundary = boundary_nodes(input);
  for (Index f = 0; f < input.face_count(); ++f) {
    const auto face = input.face(f);
    const bool stays = std::all_of(face.begin(), face.end(), [&](Index i) { return constraints.position_fixed(i); });
    if (stays &&
        std::any_of(face.begin(), face.end(), [&](Index i) { return boundary[static_cast<std::size_t>(i)] == 0; })) {
      EXPECT_TRUE(faces.contains({face.begin(), face.end()})) << "face " << f;
    }
  }
}

Refined refined_by_length(const PolygonMesh& mesh, const Constraints& constraints, double length) {
  Refined refined = refine(mesh, constraints, {.length = length});
  expect_sound(mesh, constraints, refined);
  return refined;
}

std::set<std::size_t> sizes_of_faces(const PolygonMesh& mesh) {
  std::set<std::size_t> sizes;
  for (Index f = 0; f < mesh.face_count(); ++f) sizes.insert(mesh.face(f).size());
  return sizes;
}

double least_angle(const PolygonMesh& mesh) {
  double least = 180;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector3 in = mesh.position(face[(k + face.size() - 1) % face.size()]) - mesh.position(face[k]);
      const Vector3 out = mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k]);
      least = std::min(least, std::atan2(in.cross(out).norm(), in.dot(out)) / degree);
    }
  }
  return least;
}

/// Nodes within a ball may move.
Constraints ball_moves(const PolygonMesh& mesh, const Vector3& centre, double radius) {
  Constraints constraints(mesh.node_count());
  restrict_to_region(constraints, mesh, select_region(mesh.positions(), {.extent = SphereRegion{centre, radius}}));
  return constraints;
}

TEST(Refine, NoMovingEdgeIsLongerOnAnyKindOfMesh) {
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh mesh = generate::saddle({.columns = 4, .rows = 5, .faces = faces});
    const Constraints held = held_boundary(mesh);
    for (const double length : {0.31, 0.1, 0.05}) {
      const Refined refined = refined_by_length(mesh, held, length);
      EXPECT_LE(longest_moving(refined), length);
      EXPECT_GT(longest_moving(refined), length / 2.9);
      // At a held boundary, too.
      for (const auto& [edge, count] : edges_of(refined.mesh)) EXPECT_LE(length_of(refined.mesh, edge), length);
    }
  }
}

TEST(Refine, TrianglesAndQuadsStaySuch) {
  const PolygonMesh quads = generate::saddle({.columns = 3, .rows = 7, .faces = generate::Faces::quads});
  EXPECT_EQ(sizes_of_faces(refined_by_length(quads, held_boundary(quads), 0.1).mesh), std::set<std::size_t>{4});
  const PolygonMesh triangles = in_triangles(quads);
  EXPECT_EQ(sizes_of_faces(refined_by_length(triangles, held_boundary(triangles), 0.1).mesh), std::set<std::size_t>{3});
}

TEST(Refine, OnlyTheLongSidesOfRectanglesAreHalved) {
  const PolygonMesh mesh = generate::plane({.columns = 2, .rows = 2, .faces = generate::Faces::quads}, 8, 1);
  const Refined refined = refined_by_length(mesh, held_boundary(mesh), 1);
  EXPECT_EQ(refined.mesh.face_count(), 4 * 4);
  EXPECT_EQ(sizes_of_faces(refined.mesh), std::set<std::size_t>{4});
}

TEST(Refine, AnglesOfTrianglesStayLarge) {
  // Repeated bisection of longest edges leaves at least half of the least angle (Rivara, after Rosenberg and Stenger).
  for (const double slant : {0.0, 0.5, 1.3}) {
    MeshBuilder builder;
    for (const Vector3& p :
         {Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(5, 3 + slant, 0), Vector3(1 + slant, 3, 0), Vector3(2.2, 1.4, 0)})
      builder.add_node(p);
    for (Index k = 0; k < 4; ++k) builder.add_face({k, (k + 1) % 4, 4});
    const PolygonMesh mesh = builder.take();
    const Refined refined = refined_by_length(mesh, held_boundary(mesh), 0.11);
    EXPECT_GT(least_angle(refined.mesh), least_angle(mesh) / 2) << slant;
  }
}

TEST(Refine, ARegionIsRefinedUpToItsRim) {
  for (const bool triangles : {false, true}) {
    const PolygonMesh mesh = triangles ? in_triangles(closed_sphere(8)) : closed_sphere(8);
    const Constraints constraints = ball_moves(mesh, {0, 0, 1}, 0.7);
    const Refined refined = refined_by_length(mesh, constraints, 0.08);
    EXPECT_GT(refined.new_node_count(), 100);
    // Edges of the rim stay, and are 0.2 long at most; those further inside than twice that are as short as asked for.
    const double rim = 0.21;
    for (const auto& [edge, count] : edges_of(refined.mesh)) {
      const double inside = (refined.mesh.position(edge.first) - Vector3(0, 0, 1)).norm();
      if (refined.constraints.position_fixed(edge.first) && refined.constraints.position_fixed(edge.second)) continue;
      EXPECT_LE(length_of(refined.mesh, edge), inside < 0.7 - 2 * rim ? 0.08 : rim);
    }
    EXPECT_GT(least_angle(refined.mesh), 12);
    for (Index i = mesh.node_count(); i < refined.mesh.node_count(); ++i)
      EXPECT_FALSE(refined.constraints.position_fixed(i));
  }
}

TEST(Refine, LongEdgesOfTheRimMakeNoSliversWithoutEnd) {
  for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::quads}) {
    const PolygonMesh mesh = generate::plane({.columns = 10, .rows = 10, .faces = faces}, 10, 10);
    const Constraints constraints = ball_moves(mesh, {5, 5, 0}, 2.9);
    const Refined refined = refined_by_length(mesh, constraints, 0.02);
    EXPECT_GT(least_angle(refined.mesh), 14);
    // The rim is 3 or more from the middle and its edges are 1 long: less by half of the distance.
    double longest = 0;
    for (const auto& [edge, count] : edges_of(refined.mesh)) {
      const double inside = (refined.mesh.position(edge.first) - Vector3(5, 5, 0)).norm();
      if (inside < 0.5) longest = std::max(longest, length_of(refined.mesh, edge));
    }
    EXPECT_LE(longest, 0.02);
    EXPECT_GT(refined.new_node_count(), 1000);
    EXPECT_LT(refined.new_node_count(), 60000);
  }
}

TEST(Refine, ARefinedRegionOfASphereIsNearerToIt) {
  for (const bool triangles : {false, true}) {
    const PolygonMesh mesh = triangles ? in_triangles(closed_sphere(6)) : closed_sphere(6);
    const Constraints constraints = ball_moves(mesh, {0, 0, 1}, 0.8);
    const Refined refined = refined_by_length(mesh, constraints, 0.1);
    const FairResult fair_one = fair(refined.mesh, refined.constraints);
    EXPECT_EQ(fair_one.report.outcome, Outcome::converged);
    // New nodes lie on chords, up to 2 % below the sphere; fair ones lie on it, as spheres are equilibria.
    EXPECT_GT(distance_from_unit_sphere(refined.mesh.positions()), 0.01);
    EXPECT_LT(distance_from_unit_sphere(fair_one.positions), 1e-4);
    for (Index f = 0; f < refined.mesh.face_count(); ++f) {
      const PolygonMesh after = with_positions(refined.mesh, fair_one.positions);
      EXPECT_GT(vector_area(after, f).dot(after.position(after.face(f)[0])), 0);
    }
  }
}

TEST(Refine, ByTurnAllEdgesTurnByLess) {
  // On a sphere normals are exact and turns are angles at its centre, halved with each edge.
  const PolygonMesh mesh = closed_sphere(2);
  const Constraints free(mesh.node_count());
  double before = 0;
  for (const auto& [edge, count] : edges_of(mesh)) before = std::max(before, length_of(mesh, edge));
  ASSERT_GT(before, 2 * std::sin(20 * degree));
  const Refined refined = refine(mesh, free, {.turn = 12});
  expect_sound(mesh, free, refined);
  for (const auto& [edge, count] : edges_of(refined.mesh)) {
    const Vector3 a = refined.mesh.position(edge.first).normalized();
    const Vector3 b = refined.mesh.position(edge.second).normalized();
    EXPECT_LE(std::acos(std::min(1.0, a.dot(b))) / degree, 12 * 1.01);
  }
  // The cylinder turns across its axis only.
  const PolygonMesh bent =
      generate::cylinder_patch({.columns = 6, .rows = 3, .faces = generate::Faces::quads}, 1, 120, 3);
  const Refined across = refine(bent, held_boundary(bent), {.turn = 11});
  EXPECT_EQ(across.mesh.face_count(), 2 * bent.face_count());
  // A plane does not turn.
  const PolygonMesh flat = generate::plane({.columns = 3, .rows = 3});
  EXPECT_EQ(refine(flat, held_boundary(flat), {.turn = 1}).new_node_count(), 0);
}

TEST(Refine, NewNodesAreMeansAndCarryNumbers) {
  const PolygonMesh mesh = generate::saddle({.columns = 3, .rows = 3, .faces = generate::Faces::mixed});
  const Refined refined = refined_by_length(mesh, held_boundary(mesh), 0.2);
  const std::vector<double> carried = refined.at_nodes(coordinates(mesh.positions()));
  const auto places = positions_of(carried);
  EXPECT_LT(greatest_distance(places, refined.mesh.positions()), 1e-12);
  for (Index i = refined.input_node_count(); i < refined.mesh.node_count(); ++i) {
    EXPECT_GE(refined.means(i).size(), 2U);
    for (const Index of : refined.means(i)) EXPECT_LT(of, i);
  }
  EXPECT_TRUE(says(refusal([&] { (void)refined.at_nodes(std::vector<double>(7)); }, ErrorCode::invalid_argument), "7"));
}

TEST(Refine, AHeldBoundaryStaysHeldAndAFreeOneFree) {
  const PolygonMesh mesh = generate::saddle({.columns = 3, .rows = 3});
  Constraints constraints = clamped_boundary(mesh);
  // A corner that a rule moves takes half of its neighbours' new nodes with it.
  const Vector3 place(5, 6, 7);
  constraints.fix_position(0, place);
  const Refined held = refine(mesh, constraints, {.length = 0.3});
  const std::vector<std::uint8_t> boundary = boundary_nodes(held.mesh);
  bool at_corner = false;
  for (Index i = mesh.node_count(); i < held.mesh.node_count(); ++i) {
    const bool on = boundary[static_cast<std::size_t>(i)] != 0;
    EXPECT_EQ(held.constraints.position_fixed(i), on);
    EXPECT_EQ(held.constraints.normal_fixed(i), on);
    if (!on) continue;
    const auto of = held.means(i);
    const Vector3 between = (held.constraints.position(of[0]) + held.constraints.position(of[1])) / 2;
    EXPECT_LT((held.constraints.position(i) - between).norm(), 1e-12);
    at_corner = at_corner || of[0] == 0;
  }
  EXPECT_TRUE(at_corner);
  const Refined free = refine(mesh, Constraints(mesh.node_count()), {.length = 0.3});
  for (Index i = 0; i < free.mesh.node_count(); ++i) EXPECT_FALSE(free.constraints.position_fixed(i));
}

TEST(Refine, FacesThatAreNotConvexAreCutWithoutFolds) {
  MeshBuilder builder;
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(4, 4, 0), Vector3(2, 1, 0), Vector3(0, 4, 0)})
    builder.add_node(p);
  builder.add_face({0, 1, 2, 3, 4});
  const PolygonMesh notched = builder.take();
  const Constraints free(5);
  const Refined refined = refined_by_length(notched, free, 0.7);
  EXPECT_GT(refined.new_node_count(), 20);
}

TEST(Refine, FacesThatShareTwoEdgesGetNoEdgeTwice) {
  // Two faces around a node that only they have, both with a corner that is not convex: the same diagonal would cut
  // both.
  MeshBuilder builder;
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(2, 0.7, 0), Vector3(4, 0, 0), Vector3(4, 4, 0), Vector3(0, 4, 0),
                           Vector3(4, -3, 0), Vector3(2, -0.5, 0), Vector3(0, -3, 0)})
    builder.add_node(p);
  builder.add_face({0, 1, 2, 3, 4});
  builder.add_face({2, 1, 0, 7, 6, 5});
  const PolygonMesh mesh = builder.take();
  for (const double length : {3.0, 1.0, 0.3}) {
    const Refined refined = refine(mesh, Constraints(8), {.length = length});
    for (const auto& [edge, count] : edges_of(refined.mesh)) EXPECT_LE(count, 2);
    EXPECT_EQ(euler_characteristic(refined.mesh), euler_characteristic(mesh));
    EXPECT_EQ(boundary_loops(refined.mesh).size(), 1U);
  }
}

TEST(Refine, WideFacesOfManyNodesGetANodeInside) {
  MeshBuilder builder;
  std::vector<Index> ring;
  ring.reserve(40);
  for (int k = 0; k < 40; ++k)
    ring.push_back(builder.add_node({std::cos(k * 9 * degree), std::sin(k * 9 * degree), 0}));
  builder.add_face(ring);
  const PolygonMesh disc = builder.take();
  const Refined refined = refined_by_length(disc, Constraints(40), 0.3);
  EXPECT_LE(longest_moving(refined), 0.3);
  EXPECT_GT(refined.new_node_count(), 20);
}

TEST(Refine, EdgesOfMoreThanTwoFacesKeepTheirFaces) {
  MeshBuilder builder;
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0), Vector3(0, 0, 1)})
    builder.add_node(p);
  for (const Index wing : {2, 3, 4}) builder.add_face({0, 1, wing});
  const PolygonMesh mesh = builder.take();
  const Refined refined = refine(mesh, Constraints(5), {.length = 0.3});
  int shared = 0;
  for (const auto& [edge, count] : edges_of(refined.mesh)) {
    EXPECT_LE(length_of(refined.mesh, edge), 0.3);
    shared += count == 3 ? 1 : 0;
  }
  EXPECT_EQ(shared, 4);
}

TEST(Refine, WhatCannotBeRefinedIsRefused) {
  const PolygonMesh mesh = generate::plane({.columns = 3, .rows = 3});
  const Constraints held = held_boundary(mesh);
  const auto refused = [&](const Refinement& how) {
    return refusal([&] { (void)refine(mesh, held, how); }, ErrorCode::invalid_argument);
  };
  for (const double length : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_TRUE(says(refused({.length = length}), "length"));
  for (const double turn : {0.0, -1.0, 180.0, double(NAN)}) EXPECT_TRUE(says(refused({.turn = turn}), "turn"));
  EXPECT_TRUE(says(refused({}), "one of"));
  EXPECT_TRUE(says(refused({.length = 1, .turn = 1}), "one of"));
  EXPECT_TRUE(says(refused({.length = 1e-5}), "new nodes"));
  // Along one direction only, which areas do not show.
  const PolygonMesh band = generate::plane({.columns = 3, .rows = 3}, 1e8, 1e-9);
  EXPECT_TRUE(
      says(refusal([&] { (void)refine(band, held_boundary(band), {.length = 1}); }, ErrorCode::invalid_argument),
           "new nodes"));
  EXPECT_TRUE(says(refusal([&] { (void)refine(mesh, Constraints(3), {.length = 1}); }, ErrorCode::unusable_constraint),
                   "3 nodes"));
  std::vector<Vector3> positions = mesh.positions();
  positions[5].y() = NAN;
  const PolygonMesh broken = with_positions(mesh, positions);
  const std::string message = refusal([&] { (void)refine(broken, held, {.length = 0.1}); }, ErrorCode::unusable_shape);
  EXPECT_TRUE(says(message, "node 5")) << message;
  EXPECT_TRUE(says(message, "face")) << message;
  // Where nothing moves, that does not matter.
  Constraints all(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) all.fix_position(i, mesh.position(i));
  EXPECT_EQ(refine(broken, all, {.length = 0.1}).new_node_count(), 0);
}

}  // namespace
}  // namespace vspring::refine_test
