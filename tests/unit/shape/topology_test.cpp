#include "vspring/topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vspring/error.hpp"
#include "vspring/generate.hpp"

namespace vspring::topology_test {
namespace {

// Nodes on a half circle, so that no edge has zero length and no face of three lacks area.
PolygonMesh mesh_of(Index nodes, std::initializer_list<std::initializer_list<Index>> faces) {
  MeshBuilder builder;
  for (Index i = 0; i < nodes; ++i) builder.add_node({std::cos(0.3 * i), std::sin(0.3 * i), 0});
  for (const auto& face : faces) builder.add_face(face);
  return builder.take();
}

std::string first_message(const PolygonMesh& mesh) {
  const auto defects = check(mesh);
  return defects.empty() ? "" : defects.front().message();
}

TEST(Topology, BoundaryLoopsOfManyShapes) {
  const auto loops_of = [](const PolygonMesh& mesh) {
    std::vector<std::size_t> lengths;
    for (const auto& loop : boundary_loops(mesh)) lengths.push_back(loop.size());
    std::sort(lengths.begin(), lengths.end());
    return lengths;
  };
  EXPECT_EQ(loops_of(generate::torus()), std::vector<std::size_t>());
  EXPECT_EQ(loops_of(generate::plane({.columns = 5, .rows = 3})), std::vector<std::size_t>{16});
  EXPECT_EQ(loops_of(generate::tube({.columns = 7, .rows = 2})), (std::vector<std::size_t>{7, 7}));
  EXPECT_EQ(loops_of(generate::pipe_blend({.cells = 3})), (std::vector<std::size_t>{12, 12, 12}));
  EXPECT_EQ(loops_of(mesh_of(3, {{0, 1, 2}})), std::vector<std::size_t>{3});
}

TEST(Topology, BoundaryLoopsRunInTheSenseOfTheFacesAndAlongEdges) {
  const PolygonMesh mesh = generate::annulus({.nodes = 200});
  for (const auto& loop : boundary_loops(mesh)) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Index a = loop[k];
      const Index b = loop[(k + 1) % loop.size()];
      int runs = 0;
      for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t c = 0; c < face.size(); ++c) runs += face[c] == a && face[(c + 1) % face.size()] == b ? 1 : 0;
      }
      EXPECT_EQ(runs, 1);
    }
  }
}

TEST(Topology, LoopsThatMeetAtANodeAreToldApart) {
  // Two triangles that share node 0 only: each has its own loop.
  const auto loops = boundary_loops(mesh_of(5, {{0, 1, 2}, {0, 3, 4}}));
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0].size(), 3U);
  EXPECT_EQ(loops[1].size(), 3U);
}

TEST(Topology, AMoebiusStripHasOneLoop) {
  MeshBuilder builder;
  const Index n = 12;
  for (Index k = 0; k < n; ++k) {
    builder.add_node({double(k), 0, 0});
    builder.add_node({double(k), 1, 0});
  }
  for (Index k = 0; k + 1 < n; ++k) builder.add_face({2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1});
  builder.add_face({2 * n - 2, 1, 0, 2 * n - 1});
  const auto loops = boundary_loops(builder.take());
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].size(), static_cast<std::size_t>(2 * n));
}

TEST(Topology, BoundaryNodesAreThoseOfTheLoops) {
  const PolygonMesh mesh = generate::plane({.columns = 6, .rows = 6, .faces = generate::Faces::mixed});
  const auto boundary = boundary_nodes(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Vector3& p = mesh.position(i);
    const bool at_rim = p.x() == 0 || p.y() == 0 || p.x() == 1 || p.y() == 1;
    EXPECT_EQ(boundary[static_cast<std::size_t>(i)], at_rim ? 1 : 0);
  }
}

TEST(Topology, ComponentsAreNumberedByTheirFirstNodes) {
  EXPECT_EQ(components(mesh_of(8, {{5, 1, 2}, {3, 4, 6}})), (std::vector<Index>{0, 1, 1, 2, 2, 1, 2, 3}));
}

TEST(Topology, CheckNamesEveryKindOfDefect) {
  EXPECT_EQ(first_message(generate::torus()), "");
  EXPECT_EQ(first_message(mesh_of(4, {{0, 1, 2}})), "node 3: no face uses it");
  EXPECT_EQ(first_message(mesh_of(2, {{0, 1}})), "node 0: no face uses it");
  EXPECT_EQ(check(mesh_of(2, {{0, 1}})).back().message(), "face 0: it has fewer than three nodes");
  EXPECT_EQ(first_message(mesh_of(4, {{0, 1, 2}, {0, 2, 3, 2}})), "face 1: node 2 occurs in it more than once");
  EXPECT_EQ(first_message(mesh_of(3, {{0, 1, 2}, {1, 2, 0}})), "face 1: it has the same nodes as face 0");
  EXPECT_EQ(first_message(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})), "edge 0–1: more than two faces share it");
  EXPECT_EQ(first_message(mesh_of(5, {{0, 1, 2}, {0, 3, 4}})), "node 0: its faces form more than one fan");
  EXPECT_EQ(first_message(mesh_of(4, {{0, 1, 2}, {0, 1, 3}})),
            "edge 0–1: its two faces run along it in the same direction");
  const PolygonMesh doubled({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 4}, {0, 1, 2, 3});
  EXPECT_EQ(first_message(doubled), "edge 0–1: both ends are at the same position");
  const PolygonMesh flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 3}, {0, 1, 2});
  EXPECT_EQ(first_message(flat), "face 0: it has no area");
  const PolygonMesh broken({{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}}, {0, 3}, {0, 1, 2});
  EXPECT_EQ(first_message(broken), "node 2: a coordinate is not finite");
}

TEST(PolygonMesh, RefusesWhatIsNotSafe) {
  const std::vector<Vector3> three(3, Vector3::Zero());
  const auto message = [&](std::vector<Index> begin, std::vector<Index> corners) -> std::string {
    try {
      const PolygonMesh mesh(three, std::move(begin), std::move(corners));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unusable_shape);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({0, 3}, {0, 1, 2}), "");
  EXPECT_EQ(message({0, 3}, {0, 1, 3}), "face 0: node 3 does not exist, nodes go from 0 to 2");
  EXPECT_EQ(message({0, 3}, {0, -1, 2}), "face 0: node -1 does not exist, nodes go from 0 to 2");
  EXPECT_EQ(message({0, 1000000, 3}, {0, 1, 2}), "face 1: its offset lies behind that of the next face");
  EXPECT_NE(message({0, 2}, {0, 1, 2}), "");
  EXPECT_NE(message({}, {}), "");
  PolygonMesh mesh(three, {0, 3}, {0, 1, 2});
  EXPECT_THROW(mesh.set_positions(std::vector<Vector3>()), Error);
  EXPECT_EQ(mesh.node_count(), 3);
}

}  // namespace
}  // namespace vspring::topology_test
