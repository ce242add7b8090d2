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
      const PolygonMesh few = crumpled(faces, 12);
      const std::size_t pairs = self_intersections(few, context, team).size();
      EXPECT_GT(pairs, 100);
      EXPECT_EQ(count_self_intersections(few, context, team), pairs);
    }
    const PolygonMesh many = crumpled(threads == 1 ? generate::Faces::quads : generate::Faces::triangles, 60);
    EXPECT_EQ(count_self_intersections(many, context, team), most_counted_crossings);
  }
}

}  // namespace
}  // namespace vspring::self_intersections_test
