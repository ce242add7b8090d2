// What check() says about a mesh does not depend on its size, its place or its numbering.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "base/random.hpp"
#include "vspring/generate.hpp"
#include "vspring/topology.hpp"

namespace vspring::defects_test {
namespace {

using generate::Faces;
using Kind = Defect::Kind;

PolygonMesh scaled(PolygonMesh mesh, double scale, const Vector3& shift = Vector3::Zero()) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position = scale * position + shift;
  mesh.set_positions(std::move(positions));
  return mesh;
}

TEST(Defects, FacesHaveAreaAtEverySize) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const PolygonMesh patch = generate::sphere_patch({.columns = 6, .rows = 6, .faces = faces, .jitter = 0.4});
    for (const double scale : {1e-300, 1e-160, 1e-30, 1.0, 1e30, 1e160, 1e300})
      EXPECT_TRUE(check(scaled(patch, scale)).empty()) << scale;
    EXPECT_TRUE(check(scaled(patch, 1e-3, Vector3(1e6, -2e6, 3e6))).empty());
  }
}

TEST(Defects, AFarNodeDoesNotTakeTheAreaOfOthers) {
  const PolygonMesh patch = generate::plane({.columns = 4, .rows = 4, .faces = Faces::quads});
  std::vector<Vector3> positions = patch.positions();
  positions[0] = Vector3(-1e200, -1e200, 0);
  PolygonMesh stretched = patch;
  stretched.set_positions(positions);
  for (const Defect& defect : check(stretched)) EXPECT_EQ(defect.face, 0) << defect.message();
}

TEST(Defects, CollinearFacesAreFoundAtEverySize) {
  const PolygonMesh line({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {0.5, 1, 1.5}}, {0, 4}, {0, 1, 2, 3});
  for (const double scale : {1e-300, 1e-30, 1.0, 1e30, 1e300}) {
    const auto defects = check(scaled(line, scale));
    ASSERT_EQ(defects.size(), 1U) << scale;
    EXPECT_EQ(defects[0].kind, Kind::zero_area_face);
    EXPECT_EQ(faces_without_area(scaled(line, scale)), std::vector<Index>{0});
  }
}

TEST(Defects, ComeByKindThenElementAndEveryEdgeOnce) {
  // A fin on edge 6–7 and one on edge 1–2 (given last), a doubled face and two lone nodes, in the middle of a grid.
  const PolygonMesh plane = generate::plane({.columns = 4, .rows = 4, .faces = Faces::quads});
  MeshBuilder builder;
  for (const Vector3& position : plane.positions()) builder.add_node(position);
  for (int k = 0; k < 4; ++k) builder.add_node({0.3 * k, 0.2, 1});
  for (Index f = 0; f < plane.face_count(); ++f) builder.add_face(plane.face(f));
  builder.add_face({7, 6, 25});
  builder.add_face({12, 13, 18, 17});
  builder.add_face({6, 11, 26});
  const auto defects = check(builder.take());
  std::vector<std::string> messages;
  for (const Defect& defect : defects) {
    if (defect.kind != Kind::orientation) messages.push_back(defect.message());
  }
  const std::vector<std::string> expected = {"node 27: no face uses it",
                                             "node 28: no face uses it",
                                             "face 17: it has the same nodes as face 10",
                                             "edge 6–7: more than two faces share it",
                                             "edge 6–11: more than two faces share it",
                                             "edge 12–13: more than two faces share it",
                                             "edge 12–17: more than two faces share it",
                                             "edge 13–18: more than two faces share it",
                                             "edge 17–18: more than two faces share it"};
  EXPECT_EQ(messages, expected);
}

// Faces of random nodes: everything that can be wrong, together.
PolygonMesh random_mesh(Random& random) {
  MeshBuilder builder;
  const auto nodes = static_cast<std::uint64_t>(4 + random.below(8));
  for (std::uint64_t i = 0; i < nodes; ++i) {
    const double special[] = {0, 1, -1, 1e300, std::numeric_limits<double>::quiet_NaN()};
    builder.add_node({special[random.below(5)], special[random.below(4)], special[random.below(3)]});
  }
  for (std::uint64_t f = random.below(14); f > 0; --f) {
    std::vector<Index> face(random.below(6));
    for (Index& node : face) node = static_cast<Index>(random.below(nodes));
    builder.add_face(face);
  }
  return builder.take();
}

TEST(Defects, AnyMeshCanBeLookedAt) {
  Random random(5);
  for (int k = 0; k < 3000; ++k) {
    const PolygonMesh mesh = random_mesh(random);
    // Every edge of one face lies on a loop, once.
    std::size_t on_loops = 0;
    std::set<Index> of_loops;
    for (const auto& loop : boundary_loops(mesh)) {
      on_loops += loop.size();
      of_loops.insert(loop.begin(), loop.end());
    }
    const auto boundary = boundary_nodes(mesh);
    for (Index i = 0; i < mesh.node_count(); ++i)
      EXPECT_EQ(boundary[static_cast<std::size_t>(i)] != 0, of_loops.count(i) == 1) << "mesh " << k;
    EXPECT_GE(on_loops, of_loops.size());
    for (const Defect& defect : check(mesh)) EXPECT_FALSE(defect.message().empty());
    const auto component = components(mesh);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      for (const Index i : mesh.face(f))
        EXPECT_EQ(component[static_cast<std::size_t>(i)], component[static_cast<std::size_t>(mesh.face(f)[0])]);
    }
  }
}

}  // namespace
}  // namespace vspring::defects_test
