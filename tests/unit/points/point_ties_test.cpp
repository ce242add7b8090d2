#include "points/point_ties.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "points/nearest_nodes.hpp"
#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "support/curves.hpp"
#include "support/surfaces.hpp"

namespace vspring::point_ties_test {
namespace {

using namespace support;

std::size_t nearest_of(const std::vector<Vector3>& nodes, const Vector3& point) {
  const auto nearer = [&](const Vector3& a, const Vector3& b) { return (a - point).norm() < (b - point).norm(); };
  return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end(), nearer) - nodes.begin());
}

std::vector<Vector3> scattered(int count) {
  Draw draw(9);
  std::vector<Vector3> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int j = 0; j < count; ++j) points.emplace_back(draw.uniform(-0.2, 1.2), draw.uniform(-0.2, 1.2), 0.1);
  return points;
}

/// A plane with its boundary held.
struct Plane {
  PolygonMesh mesh = generate::plane({.columns = 12, .rows = 12, .faces = generate::Faces::mixed, .jitter = 0.4});
  std::vector<std::uint8_t> all = std::vector<std::uint8_t>(static_cast<std::size_t>(mesh.node_count()), 1);
  Net net = gather_net(mesh, held_boundary(mesh));
};

/// The nodes of the net that the points are tied to, point by point as the net has them.
std::vector<std::size_t> ties_of(const Net& net) {
  std::vector<std::size_t> node(net.points.positions.size(), net.node.size());
  for (std::size_t i = 0; i < net.node.size(); ++i) {
    for (const std::uint32_t k : net.points.of(i)) node[k] = i;
  }
  return node;
}

TEST(NearestNodes, AreTheNearestOfThoseThatCount) {
  Plane plane;
  ThreadTeam team(2);
  const std::vector<Vector3> points = scattered(500);
  const std::vector<Index> nearest = nearest_nodes(points, plane.mesh.positions(), plane.all, team);
  for (std::size_t j = 0; j < points.size(); ++j)
    EXPECT_EQ(static_cast<std::size_t>(nearest[j]), nearest_of(plane.mesh.positions(), points[j]));
  plane.all[static_cast<std::size_t>(nearest[0])] = 0;
  EXPECT_NE(nearest_nodes(points, plane.mesh.positions(), plane.all, team)[0], nearest[0]);
}

TEST(NearestNodes, ThoseWithoutAPlaceAreNearToNothing) {
  ThreadTeam team(1);
  std::vector<Vector3> nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<std::uint8_t> all(3, 1);
  const std::vector<Vector3> points = {{1, 0.1, 0}, {0, 1, 0}};
  nodes[1].x() = NAN;
  EXPECT_EQ(nearest_places(points, nodes, all, team), (std::vector<Index>{0, 0}));
  for (Vector3& node : nodes) node = Vector3(1e200, 0, 0);
  EXPECT_EQ(nearest_places(points, nodes, all, team), (std::vector<Index>{-1, -1}));
  for (Vector3& node : nodes) node.z() = INFINITY;
  EXPECT_EQ(nearest_places(points, nodes, all, team), (std::vector<Index>{-1, -1}));
}

TEST(PointTies, StayWhereAShapeHasLostItsPlaces) {
  Plane plane;
  ThreadTeam team(1);
  const std::vector<Vector3> points = scattered(50);
  const std::vector<Index> nearest = nearest_nodes(points, plane.mesh.positions(), plane.all, team);
  PointTies ties(plane.net, points, std::vector<double>(points.size(), 1), nearest, nullptr);
  const std::vector<std::size_t> before = ties_of(plane.net);
  for (Vector3& place : plane.net.positions) place.x() = NAN;
  ties.tie_anew(team);
  EXPECT_EQ(ties_of(plane.net), before);
}

TEST(NearestNodes, OfEquallyNearOnesTheFirst) {
  ThreadTeam team(1);
  const std::vector<Vector3> nodes(9, Vector3(1, 2, 3));
  const std::vector<std::uint8_t> usable = {0, 0, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(nearest_nodes(std::vector<Vector3>{{0, 0, 0}}, nodes, usable, team), std::vector<Index>{2});
  EXPECT_EQ(nearest_nodes(std::vector<Vector3>{{0, 0, 0}}, nodes, std::vector<std::uint8_t>(9, 0), team),
            std::vector<Index>{-1});
}

TEST(PointTies, HoldEveryPointThatHasWeightAndANodeOfTheNet) {
  Plane plane;
  ThreadTeam team(1);
  const std::vector<Vector3> points = scattered(500);
  std::vector<double> weights(500, 2);
  weights[7] = 0;
  std::vector<Index> nearest = nearest_nodes(points, plane.mesh.positions(), plane.all, team);
  nearest[8] = -1;
  PointTies ties(plane.net, points, weights, nearest);
  ASSERT_EQ(plane.net.points.positions.size(), 498U);
  const auto tied = ties_of(plane.net);
  for (std::size_t k = 0; k < tied.size(); ++k) {
    EXPECT_EQ(tied[k], nearest_of(plane.net.positions, plane.net.points.positions[k]));
    EXPECT_EQ(plane.net.points.weights[k], 2);
  }
}

TEST(PointTies, ChangeOverToNodesThatComeNearer) {
  Plane plane;
  const std::vector<Vector3> points = scattered(500);
  ThreadTeam team(3);
  PointTies ties(plane.net, points, std::vector<double>(500, 1),
                 nearest_nodes(points, plane.mesh.positions(), plane.all, team));
  const auto before = ties_of(plane.net);
  // By less than a cell: the nearest node is then a neighbour of first or second order.
  for (Vector3& position : plane.net.positions) position += Vector3(0.02, 0.01, 0) * plane.net.frame.scale();
  ties.renew(team);
  const auto after = ties_of(plane.net);
  EXPECT_NE(before, after);
  for (std::size_t k = 0; k < after.size(); ++k)
    EXPECT_EQ(after[k], nearest_of(plane.net.positions, plane.net.points.positions[k]));
}

TEST(PointTies, PassWhereChainsMeet) {
  // Three arms that meet at node 0, which is held.
  std::vector<Vector3> positions = {{0, 0, 0}};
  std::vector<PolygonCurve::Chain> chains;
  for (int arm = 0; arm < 3; ++arm) {
    PolygonCurve::Chain chain{.nodes = {0}};
    for (int k = 1; k <= 4; ++k) {
      chain.nodes.push_back(static_cast<Index>(positions.size()));
      positions.emplace_back(k * heading(2 * arm));
    }
    chains.push_back(chain);
  }
  const PolygonCurve curve(positions, chains);
  Constraints held(curve.node_count());
  fix_boundary_positions(held, curve);
  Net net = gather_net(curve, held);
  const Vector3 point = heading(4);
  PointTies ties(net, std::vector<Vector3>{point}, std::vector<double>{1}, std::vector<Index>{5});
  ThreadTeam team(1);
  ties.renew(team);
  EXPECT_EQ(net.node[ties_of(net)[0]], 9);
}

TEST(PointTies, PassAHubOfManyFaces) {
  MeshBuilder builder;
  constexpr int sides = 300;
  std::vector<Index> rim;
  const Index hub = builder.add_node({0, 0, 0});
  rim.reserve(sides);
  for (int i = 0; i < sides; ++i) rim.push_back(builder.add_node(heading(360 * degree * i / sides)));
  for (std::size_t i = 0; i < sides; ++i) {
    const std::vector<Index> face = {hub, rim[i], rim[(i + 1) % sides]};
    builder.add_face(face);
  }
  const PolygonMesh fan = builder.take();
  Net net = gather_net(fan, held_boundary(fan));
  const std::vector<Vector3> points = {heading(2), {0.1, 0, 0}};
  PointTies ties(net, points, std::vector<double>(2, 1), std::vector<Index>{hub, rim[150]});
  ThreadTeam team(1);
  ties.renew(team);
  const auto tied = ties_of(net);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(tied[k], nearest_of(net.positions, net.points.positions[k]));
}

TEST(PointTies, PassAHeldNode) {
  Plane plane{generate::plane({.columns = 12, .rows = 12, .faces = generate::Faces::quads})};
  // The corner, across a cell, has no ring that would tell its neighbours.
  ThreadTeam team(1);
  const std::vector<Vector3> points = {plane.mesh.position(14)};
  PointTies ties(plane.net, points, std::vector<double>{1}, std::vector<Index>{0});
  ties.renew(team);
  EXPECT_EQ(plane.net.node[ties_of(plane.net)[0]], 14);
}

TEST(PointTies, FaceAsTheirPointsDo) {
  Plane plane;
  ThreadTeam team(2);
  const auto model = surface_model(PseudoNormals::link);
  update_directions(plane.net, *model, team);
  const Vector3 up = plane.net.normals[0];
  const std::vector<Vector3> points = {{0.5, 0.5, 0.1}, {0.5, 0.5, 0.1}, {0.5, 0.5, 0.1}};
  const std::vector<Vector3> normals = {up, -up, Vector3::Zero()};
  PointTies ties(plane.net, points, std::vector<double>(3, 1),
                 nearest_nodes(points, plane.mesh.positions(), plane.all, team), nullptr, normals);
  const std::size_t none = plane.net.node.size();
  const std::size_t nearest = ties_of(plane.net)[0];
  EXPECT_LT(nearest, none);
  EXPECT_EQ(ties_of(plane.net), (std::vector<std::size_t>{nearest, none, nearest}));
  EXPECT_FALSE(ties.renew(team));
  // Another node of the neighbourhood turns over.
  const std::size_t other = plane.net.rings.links(nearest).front().node();
  plane.net.normals[other] = -up;
  EXPECT_TRUE(ties.renew(team));
  EXPECT_EQ(ties_of(plane.net), (std::vector<std::size_t>{nearest, other, nearest}));
  // Nothing changes over any more where that takes more than a right angle.
  plane.net.normals[other] = up;
  EXPECT_FALSE(ties.renew(team, 2));
  EXPECT_TRUE(ties.renew(team));
  EXPECT_EQ(ties_of(plane.net)[1], none);
  plane.net.normals[other] = -up;
  ties.tie_anew(team);
  EXPECT_EQ(ties_of(plane.net)[1], other);
}

}  // namespace
}  // namespace vspring::point_ties_test
