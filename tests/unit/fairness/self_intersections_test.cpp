#include "fairness/self_intersections.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.hpp"
#include "support/surfaces.hpp"

namespace vspring::self_intersections_test {
namespace {

using namespace support;

/// A mesh whose nodes lie anywhere in a cube.
PolygonMesh crumpled(generate::Faces faces, Index cells) {
  const PolygonMesh plane = generate::plane({.columns = cells, .rows = cells, .faces = faces});
  Random random(1);
  std::vector<Vector3> positions(plane.positions().size());
  for (Vector3& position : positions)
    position = Vector3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  return with_positions(plane, positions);
}

TEST(CountSelfIntersections, IsThatOfThePairsUpToTheMostThatIsCounted) {
  const Context context;
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::quads, generate::Faces::mixed}) {
      const PolygonMesh mesh = crumpled(faces, 12);
      const std::size_t pairs = self_intersections(mesh, context, team).size();
      EXPECT_GT(pairs, 100);
      EXPECT_EQ(count_self_intersections(mesh, context, team), pairs);
      for (const std::size_t most : {pairs / 10, pairs - 1})
        EXPECT_EQ(count_self_intersections(mesh, context, team, most), most);
    }
  }
}

/// Two faces of so many nodes each.
PolygonMesh two_faces(const std::vector<Vector3>& first, const std::vector<Vector3>& second) {
  MeshBuilder builder;
  for (const auto* face : {&first, &second}) {
    std::vector<Index> nodes;
    for (const Vector3& place : *face) nodes.push_back(builder.add_node(place));
    builder.add_face(nodes);
  }
  return builder.take();
}

TEST(SelfIntersections, OfQuadsAreThoseByEitherDiagonal) {
  const std::vector<Vector3> flat = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto stands_at = [](double height) {
    return std::vector<Vector3>{{0.2, 0.5, height}, {0.8, 0.5, height}, {0.8, 0.5, 2}, {0.2, 0.5, 2}};
  };
  EXPECT_EQ(self_intersections(two_faces(flat, stands_at(-0.1))).size(), 1U);
  EXPECT_TRUE(self_intersections(two_faces(flat, stands_at(0.1))).empty());
  // By one diagonal its middle is at a height of 0.2, by the other at 0.
  const std::vector<Vector3> bent = {{0, 0, 0.2}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}};
  EXPECT_TRUE(self_intersections(two_faces(bent, stands_at(0.1))).empty());
  EXPECT_EQ(self_intersections(two_faces(bent, stands_at(-0.1))).size(), 1U);
}

TEST(SelfIntersections, AreNoneOfQuadsThatShareAnEdgeAndFold) {
  // They lie over each other, the second one with a corner below.
  const std::vector<Vector3> flat = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vector3> folded = {{1, 0, 0}, {0, 0, 0}, {0, 0.9, 0.2}, {0.9, 0.9, -0.2}};
  EXPECT_TRUE(self_intersections(two_faces(flat, folded)).empty());
  const std::vector<Vector3> apart = {{1, 0.01, 0}, {0, 0.01, 0}, {0, 0.9, 0.2}, {0.9, 0.9, -0.2}};
  EXPECT_EQ(self_intersections(two_faces(flat, apart)).size(), 1U);
}

}  // namespace
}  // namespace vspring::self_intersections_test
