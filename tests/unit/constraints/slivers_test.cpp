#include "constraints/slivers.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vspring::slivers_unit_test {
namespace {

using Face = std::vector<Index>;

TEST(Slivers, BesideEachOtherAreLeftOutInTurns) {
  // Nodes 4 and 5 lie on the edge between 0 and 1.
  MeshBuilder builder;
  for (const Vector3& place :
       {Vector3(0, 0, 0), Vector3(3, 0, 0), Vector3(1, -2, 0), Vector3(1, 2, 0), Vector3(1, 0, 0), Vector3(2, 0, 0)})
    builder.add_node(place);
  builder.add_face({0, 2, 1});
  builder.add_face({0, 1, 5});
  builder.add_face({0, 5, 4});
  builder.add_face({0, 4, 5, 1, 3});
  const PolygonMesh mesh = builder.take();
  Constraints held(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) held.fix_position(i, mesh.position(i));
  const PolygonMesh result = Slivers(mesh).left_out(held);
  const auto nodes = [&](Index face) { return Face(result.face(face).begin(), result.face(face).end()); };
  EXPECT_EQ(nodes(0), (Face{0, 2, 1, 5, 4}));
  EXPECT_EQ(nodes(1).size(), 2U);
  EXPECT_EQ(nodes(2).size(), 2U);
  EXPECT_EQ(nodes(3), (Face{0, 4, 5, 1, 3}));
  EXPECT_TRUE(Slivers(mesh).left_out(Constraints(mesh.node_count())).has_same_faces(mesh));
}

}  // namespace
}  // namespace vspring::slivers_unit_test
