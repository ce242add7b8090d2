// Distances between shapes against closed forms and against comparing all.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vspring/vspring.hpp"

namespace vspring::fairness_distance_test {
namespace {

using generate::Faces;

TEST(Distance, BetweenNodes) {
  const std::vector<Vector3> before = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Vector3> after = {{0, 0, 0}, {1, 3, 0}, {2, 0, 4}};
  const Distance distance = node_distance(before, after);
  EXPECT_NEAR(distance.greatest, 4, 1e-15);
  EXPECT_NEAR(distance.rms, 5 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(distance.node, 2);
  EXPECT_EQ(distance.count, 3);
  EXPECT_THROW((void)node_distance(before, std::vector<Vector3>(2, Vector3::Zero())), Error);
}

TEST(Distance, OfASphereToOneWithinIt) {
  const PolygonMesh outer = generate::cap({.nodes = 3000, .radius = 1.1, .half_angle = 50});
  const PolygonMesh inner = generate::sphere_patch({.columns = 80, .rows = 80, .faces = Faces::mixed}, 1, 150);
  const Distance found = distance(outer.positions(), inner);
  EXPECT_NEAR(found.rms, 0.1, 1e-3);
  EXPECT_NEAR(found.greatest, 0.1, 1e-3);
  EXPECT_EQ(found.count, 3000);
}

TEST(Distance, OfNodesOnThePolygonsIsNone) {
  const PolygonMesh coarse = generate::plane({.columns = 3, .rows = 5, .faces = Faces::hexagons}, 2, 1);
  const PolygonMesh fine = generate::plane({.columns = 31, .rows = 17, .jitter = 0.4}, 2, 1);
  EXPECT_LT(distance(fine.positions(), coarse).greatest, 1e-15);
  // Beyond its rim it is the distance to the rim.
  EXPECT_NEAR(distance(std::vector<Vector3>{{3, 2, 1}}, coarse).greatest, std::sqrt(3.0), 1e-14);
}

TEST(Distance, IsTheLeastOfAllFaces) {
  const PolygonMesh mesh = generate::add_noise(generate::torus({.columns = 12, .rows = 6, .faces = Faces::quads}), 0.3);
  const PolygonMesh points = generate::add_noise(generate::plane({.columns = 9, .rows = 9}, 3, 3), 1, 4, true);
  for (const Vector3& point : points.positions()) {
    double least = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < mesh.face_count(); ++f) {
      MeshBuilder one;
      for (const Vector3& position : mesh.positions()) one.add_node(position);
      one.add_face(mesh.face(f));
      least = std::min(least, distance(std::vector{point}, one.take()).greatest);
    }
    EXPECT_NEAR(distance(std::vector{point}, mesh).greatest, least, 1e-13);
  }
}

TEST(Distance, NodesOfNoFaceOrEdgeAreNoPartOfAShape) {
  MeshBuilder builder;
  for (const Vector3& node : {Vector3(9, 9, 9), Vector3(0, 0, 1), Vector3(1, 0, 2), Vector3(0, 1, 1)})
    builder.add_node(node);
  builder.add_face({1, 2, 3});
  const PolygonMesh mesh = builder.take();
  EXPECT_EQ(distance(mesh, mesh).greatest, 0);
  const Distance found = distance(mesh, generate::plane({.columns = 3, .rows = 3}, 2, 2));
  EXPECT_NEAR(found.greatest, 2, 1e-15);
  EXPECT_EQ(found.node, 2);
  EXPECT_EQ(found.count, 3);
  PolygonCurve curve({{0, 0, 0}, {1, 0, 0}, {5, 5, 5}});
  EXPECT_EQ(distance(curve, curve).count, 3);
}

TEST(Distance, PointByPoint) {
  const PolygonMesh plane = generate::plane({.columns = 3, .rows = 5}, 2, 1);
  const PolygonCurve edge({{0, 0, 0}, {1, 0, 0}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector3> points = {{0.5, 0.5, 3}, {0, 0, 0}, {nan, 0, 0}, {0.5, 0, -4}};
  const std::vector<double> to_plane = point_distances(points, plane, Context());
  const std::vector<double> to_edge = point_distances(points, edge, Context());
  const double wanted[] = {3, 0, 0, 4};
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(to_plane[k], wanted[k], 1e-14);
  EXPECT_NEAR(to_edge[0], std::sqrt(9.25), 1e-14);
  EXPECT_NEAR(to_edge[3], 4, 1e-14);
  EXPECT_EQ(distance(points, plane).count, 3);
}

TEST(Distance, ToACurve) {
  const PolygonCurve square({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, true);
  const Distance found = distance(std::vector<Vector3>{{0.5, 0.4, 0}, {0.1, 0.5, 0}, {2, 2, 0}}, square);
  EXPECT_NEAR(found.greatest, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(found.rms, std::sqrt((0.16 + 0.01 + 2) / 3), 1e-15);
  EXPECT_THROW((void)distance(std::vector<Vector3>{{0, 0, 0}}, PolygonCurve({{0, 0, 0}})), Error);
}

TEST(Distance, IsTheSameForEveryNumberOfThreadsAndScales) {
  const PolygonMesh mesh = generate::add_noise(generate::torus(), 0.1);
  const PolygonMesh other = generate::torus({.columns = 33, .rows = 17});
  Context one;
  one.threads = 1;
  Context four;
  four.threads = 4;
  const Distance a = distance(mesh.positions(), other, one);
  const Distance b = distance(mesh.positions(), other, four);
  EXPECT_EQ(a.greatest, b.greatest);
  EXPECT_EQ(a.rms, b.rms);
  EXPECT_EQ(a.node, b.node);
}

}  // namespace
}  // namespace vspring::fairness_distance_test
