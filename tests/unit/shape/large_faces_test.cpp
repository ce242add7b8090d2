#include "shape/large_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "vspring/generate.hpp"

namespace vspring::large_faces_test {
namespace {

/// How often each edge is passed, in either sense.
std::map<std::pair<Index, Index>, int> edges(const PolygonMesh& mesh) {
  std::map<std::pair<Index, Index>, int> passed;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) ++passed[{face[k], face[(k + 1) % face.size()]}];
  }
  return passed;
}

TEST(LargeFaces, ThoseUpToTheLimitStayAsTheyAre) {
  EXPECT_FALSE(with_large_faces_cut(generate::polygon_patch({.sides = 128, .rings = 2})));
}

TEST(LargeFaces, OthersAreCutIntoSmallOnesThatFitTogether) {
  for (const int sides : {129, 136, 137, 1000, 1001, 10'000}) {
    const PolygonMesh mesh = generate::polygon_patch({.sides = sides, .rings = 2});
    const auto cut = with_large_faces_cut(mesh);
    ASSERT_TRUE(cut) << sides;
    EXPECT_EQ(cut->mesh.positions(), mesh.positions());
    const auto before = edges(mesh);
    const auto after = edges(cut->mesh);
    for (const auto& [edge, count] : before) EXPECT_EQ(after.at(edge), count);
    // Each cut is an edge of two pieces, passed once in each sense.
    EXPECT_EQ(after.size(), before.size() + 2 * cut->cuts.size());
    for (const auto& [a, b] : cut->cuts) {
      EXPECT_EQ(after.at({a, b}), 1);
      EXPECT_EQ(after.at({b, a}), 1);
      EXPECT_FALSE(before.contains({a, b}) || before.contains({b, a}));
    }
    EXPECT_EQ(cut->mesh.face_count(), mesh.face_count() + static_cast<Index>(cut->cuts.size()));
    for (Index f = 0; f < cut->mesh.face_count(); ++f) {
      EXPECT_GE(cut->mesh.face(f).size(), 3U);
      EXPECT_LE(cut->mesh.face(f).size(), 16U);
    }
    // No node is joined to more than some others, however large the face.
    std::map<Index, int> met;
    for (const auto& [a, b] : cut->cuts) {
      ++met[a];
      ++met[b];
    }
    for (const auto& [node, count] : met) EXPECT_LE(count, 12) << sides << ", node " << node;
  }
}

TEST(LargeFaces, TheSameRimFromBothSidesIsCutOnce) {
  MeshBuilder builder;
  std::vector<Index> rim(200);
  std::iota(rim.begin(), rim.end(), 0);
  for (std::size_t k = 0; k < rim.size(); ++k) builder.add_node(Vector3(static_cast<double>(k), 0, 0));
  builder.add_face(rim);
  std::reverse(rim.begin(), rim.end());
  builder.add_face(rim);
  const auto cut = with_large_faces_cut(builder.take());
  ASSERT_TRUE(cut);
  for (const auto& [edge, count] : edges(cut->mesh)) EXPECT_EQ(count, 1) << edge.first << " " << edge.second;
}

}  // namespace
}  // namespace vspring::large_faces_test
