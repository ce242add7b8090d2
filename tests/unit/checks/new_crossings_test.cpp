#include "checks/new_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/surfaces.hpp"

namespace vspring::new_crossings_test {
namespace {

using namespace support;

// Of a sheet along each side. Nodes are numbered row by row, and so are the quads.
constexpr Index cells = 10;
constexpr Index nodes_of_sheet = (cells + 1) * (cells + 1);

/// Two sheets, the second over the first at this height.
PolygonMesh two_sheets(double height) {
  const PolygonMesh sheet = generate::plane({.columns = cells, .rows = cells, .faces = generate::Faces::quads});
  MeshBuilder builder;
  for (const double z : {0.0, height}) {
    for (const Vector3& p : sheet.positions()) builder.add_node(p + Vector3(0, 0, z));
  }
  for (const Index first : {0, nodes_of_sheet}) {
    for (Index f = 0; f < sheet.face_count(); ++f) {
      std::vector<Index> nodes(sheet.face(f).begin(), sheet.face(f).end());
      for (Index& node : nodes) node += first;
      builder.add_face(nodes);
    }
  }
  return builder.take();
}

/// A node of the first sheet.
Index node_at(Index row, Index column) { return row * (cells + 1) + column; }

std::string said_of(const PolygonMesh& mesh, const std::vector<Vector3>& positions) {
  ThreadTeam team(2);
  return new_crossings(mesh, positions, Context(), team);
}

std::vector<Vector3> with_spike(const PolygonMesh& mesh, Index node, double height) {
  std::vector<Vector3> positions = mesh.positions();
  positions[static_cast<std::size_t>(node)] += Vector3(0.01, 0.02, height);
  return positions;
}

TEST(NewCrossings, AreNamedAsInTheMesh) {
  const PolygonMesh mesh = two_sheets(0.5);
  EXPECT_EQ(said_of(mesh, mesh.positions()), "");
  EXPECT_EQ(said_of(mesh, with_spike(mesh, node_at(7, 6), 0.4)), "") << "below the other sheet";
  // The quads below and left of the node, and the one of the other sheet above that.
  const std::string said = said_of(mesh, with_spike(mesh, node_at(7, 6), 0.6));
  EXPECT_NE(said.find("(faces 65 and 1"), std::string::npos) << said;
  EXPECT_NE(said.find(", 0 did before"), std::string::npos) << said;
}

TEST(NewCrossings, OfFacesThatDidNotMoveAreNotCounted) {
  PolygonMesh mesh = two_sheets(0.5);
  mesh.set_positions(with_spike(mesh, node_at(1, 1), 0.6));
  EXPECT_EQ(said_of(mesh, mesh.positions()), "");
  EXPECT_EQ(said_of(mesh, with_spike(mesh, node_at(8, 8), 0.4)), "");
  const std::string said = said_of(mesh, with_spike(mesh, node_at(8, 8), 0.6));
  EXPECT_NE(said.find(", 0 did before"), std::string::npos) << said;
}

TEST(NewCrossings, AreNoneWhereThereWereAsMany) {
  PolygonMesh mesh = two_sheets(0.5);
  mesh.set_positions(with_spike(mesh, node_at(5, 5), 0.6));
  std::vector<Vector3> all_moved = mesh.positions();
  for (Vector3& p : all_moved) p.z() *= 1.5;
  EXPECT_EQ(said_of(mesh, all_moved), "");
  const std::string said = said_of(mesh, with_spike(mesh, node_at(2, 2), 0.6));
  EXPECT_NE(said.find(", 0 did before"), std::string::npos) << said;
}

}  // namespace
}  // namespace vspring::new_crossings_test
