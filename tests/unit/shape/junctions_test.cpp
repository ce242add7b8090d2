
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "shape/sheets.hpp"

namespace vspring::junctions_test {
namespace {

using Face = std::vector<Index>;

PolygonMesh mesh_of(Index nodes, std::initializer_list<Face> faces) {
  MeshBuilder builder;
  for (Index i = 0; i < nodes; ++i) builder.add_node(Vector3(i, 0, 0));
  for (const Face& face : faces) builder.add_face(face);
  return builder.take();
}

Face face_of(const PolygonMesh& mesh, Index face) { return {mesh.face(face).begin(), mesh.face(face).end()}; }

/// Three sheets of two quads each along 0–1–2.
PolygonMesh three_sheets() {
  return mesh_of(12, {{0, 1, 4, 3}, {1, 2, 5, 4}, {0, 1, 7, 6}, {1, 2, 8, 7}, {0, 1, 10, 9}, {1, 2, 11, 10}});
}

TEST(Junctions, AreChainsFromEndToEnd) {
  const PolygonCurve lines = junction_lines(three_sheets());
  ASSERT_EQ(lines.chains().size(), 1U);
  EXPECT_EQ(lines.chains()[0].nodes, (Face{0, 1, 2}));
  EXPECT_FALSE(lines.chains()[0].closed);
}

TEST(Junctions, MayBeClosed) {
  // Three fans around one triangle's sides.
  const PolygonMesh mesh =
      mesh_of(6, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {0, 1, 5}, {1, 2, 5}, {2, 0, 5}});
  const PolygonCurve lines = junction_lines(mesh);
  ASSERT_EQ(lines.chains().size(), 1U);
  EXPECT_TRUE(lines.chains()[0].closed);
  Face nodes = lines.chains()[0].nodes;
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(nodes, (Face{0, 1, 2}));
}

TEST(Junctions, NoneWhereTwoFacesMeet) {
  EXPECT_TRUE(junction_lines(mesh_of(4, {{0, 1, 2}, {2, 1, 3}})).chains().empty());
}

TEST(Sheets, HaveNodesOfTheirOwnWhereTheyMeet) {
  const PolygonMesh mesh = three_sheets();
  const std::vector<Index> line = {0, 1, 2};
  const MeshOfSheets cut = into_sheets(mesh, line);
  EXPECT_EQ(cut.mesh.node_count(), mesh.node_count() + 6);
  EXPECT_EQ(cut.origin, (Face{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(face_of(cut.mesh, 0), face_of(mesh, 0)) << "the first sheet keeps its nodes";
  EXPECT_EQ(face_of(cut.mesh, 1), face_of(mesh, 1));
  EXPECT_EQ(face_of(cut.mesh, 2), (Face{12, 14, 7, 6}));
  EXPECT_EQ(face_of(cut.mesh, 3), (Face{14, 16, 8, 7}));
  for (std::size_t k = 0; k < cut.origin.size(); ++k)
    EXPECT_EQ(cut.mesh.position(mesh.node_count() + static_cast<Index>(k)), mesh.position(cut.origin[k]));
}

TEST(Sheets, OfOneNodeThatTheyShare) {
  const PolygonMesh mesh = mesh_of(5, {{0, 1, 2}, {0, 3, 4}});
  const std::vector<Index> node = {0};
  const MeshOfSheets cut = into_sheets(mesh, node);
  EXPECT_EQ(face_of(cut.mesh, 0), (Face{0, 1, 2}));
  EXPECT_EQ(face_of(cut.mesh, 1), (Face{5, 3, 4}));
}

}  // namespace
}  // namespace vspring::junctions_test
