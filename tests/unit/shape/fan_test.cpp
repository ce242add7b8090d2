#include "shape/fan.hpp"

#include <gtest/gtest.h>

namespace vspring::fan_test {
namespace {

PolygonMesh mesh_of(Index nodes, std::initializer_list<std::initializer_list<Index>> faces) {
  MeshBuilder builder;
  for (Index i = 0; i < nodes; ++i) builder.add_node(Vector3::Zero());
  for (const auto& face : faces) builder.add_face(face);
  return builder.take();
}

Fan fan_of(const PolygonMesh& mesh, Index node) {
  const Incidence incidence(mesh);
  return FanWalker(mesh, incidence).walk(node);
}

// Spokes as they are, other links negative − 1, so that node 0 can be told.
std::vector<Index> links_of(const Fan& fan) {
  std::vector<Index> nodes;
  for (const Link link : fan.links) {
    const auto node = static_cast<Index>(link.node());
    nodes.push_back(link.spoke() ? node : -node - 1);
  }
  return nodes;
}

TEST(Fan, GoesAllTheWayAroundAnInteriorNode) {
  const Fan fan = fan_of(mesh_of(4, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}}), 0);
  EXPECT_TRUE(fan.closed);
  EXPECT_TRUE(fan.manifold());
  EXPECT_EQ(links_of(fan), (std::vector<Index>{1, 2, 3}));
  EXPECT_FALSE(fan.links.front().start());
}

TEST(Fan, IsOpenAtTheBoundaryAndRunsInTheSenseOfTheFaces) {
  const Fan fan = fan_of(mesh_of(4, {{2, 3, 0}, {0, 1, 2}}), 0);
  EXPECT_FALSE(fan.closed);
  EXPECT_TRUE(fan.manifold());
  EXPECT_EQ(links_of(fan), (std::vector<Index>{1, 2, 3}));
  EXPECT_TRUE(fan.links.front().start());
}

TEST(Fan, PassesThroughTheFarNodesOfPolygons) {
  const Fan fan = fan_of(mesh_of(8, {{0, 1, 2, 3}, {0, 3, 4, 5, 6}, {0, 6, 7, 1}}), 0);
  EXPECT_TRUE(fan.closed);
  EXPECT_EQ(links_of(fan), (std::vector<Index>{1, -3, 3, -5, -6, 6, -8}));
}

TEST(Fan, HoldsInteriorNodesOfTwoEdges) {
  const Fan fan = fan_of(mesh_of(5, {{0, 1, 2, 3}, {0, 3, 4, 1}}), 0);
  EXPECT_TRUE(fan.closed);
  EXPECT_TRUE(fan.manifold());
  EXPECT_EQ(links_of(fan), (std::vector<Index>{1, -3, 3, -5}));
}

TEST(Fan, TurnsFacesOverThatRunTheOtherWay) {
  const Fan fan = fan_of(mesh_of(4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}}), 0);
  EXPECT_TRUE(fan.closed);
  EXPECT_TRUE(fan.manifold());
  EXPECT_EQ(fan.flipped_neighbour, 1);
  EXPECT_EQ(links_of(fan), (std::vector<Index>{1, 2, 3}));
}

TEST(Fan, NamesWhatIsNotManifold) {
  const Fan three = fan_of(mesh_of(5, {{0, 1, 2}, {0, 3, 1}, {0, 1, 4}}), 0);
  EXPECT_EQ(three.crowded_neighbour, 1);
  EXPECT_FALSE(three.manifold());
  const Fan bow_tie = fan_of(mesh_of(5, {{0, 1, 2}, {0, 3, 4}}), 0);
  EXPECT_EQ(bow_tie.chains, 2);
  EXPECT_FALSE(bow_tie.manifold());
  const Fan cones = fan_of(mesh_of(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}}), 0);
  EXPECT_EQ(cones.chains, 2);
  EXPECT_FALSE(cones.closed);
  EXPECT_EQ(links_of(cones), (std::vector<Index>{1, 2, 3, -2, 4, 5, 6, -5}));
  const Fan repeated = fan_of(mesh_of(4, {{0, 1, 0, 2}, {0, 2, 3}}), 0);
  EXPECT_EQ(repeated.repeating_face, 0);
  EXPECT_FALSE(repeated.manifold());
  EXPECT_EQ(fan_of(mesh_of(1, {}), 0).chains, 0);
}

}  // namespace
}  // namespace vspring::fan_test
