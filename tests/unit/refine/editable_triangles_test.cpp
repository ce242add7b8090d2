#include "refine/editable_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace vspring::editable_triangles_test {
namespace {

/// A tube of three sides and as many nodes from end to end as there are rings: node 3r + k is node k of ring r.
EditableTriangles tube(Index rings) {
  EditableTriangles tube(3 * rings);
  for (Index r = 0; r + 1 < rings; ++r) {
    for (Index k = 0; k < 3; ++k) {
      const Index a = 3 * r + k;
      const Index b = 3 * r + (k + 1) % 3;
      tube.add({.nodes = {a, b, b + 3}});
      tube.add({.nodes = {a, b + 3, a + 3}});
    }
  }
  return tube;
}

Index count(const EditableTriangles& triangles) {
  return static_cast<Index>(std::count_if(triangles.triangles().begin(), triangles.triangles().end(),
                                          [](const auto& triangle) { return triangle.is_there(); }));
}

TEST(EditableTriangles, EdgesAroundATubeOfThreeSidesDoNotCollapse) {
  const EditableTriangles triangles = tube(5);
  EXPECT_FALSE(triangles.can_collapse(6, 7));
  EXPECT_FALSE(triangles.can_collapse(7, 8));
  EXPECT_TRUE(triangles.can_collapse(6, 9));
  // Nor do edges from boundary to boundary, or those of a boundary of three.
  EXPECT_FALSE(triangles.can_collapse(0, 1));
  EXPECT_FALSE(tube(2).can_collapse(0, 3));
}

TEST(EditableTriangles, ACollapseTakesTwoTrianglesAndANode) {
  EditableTriangles triangles = tube(5);
  triangles.collapse(6, 9);
  EXPECT_EQ(count(triangles), 22);
  EXPECT_TRUE(triangles.around(6).empty());
  EXPECT_TRUE(triangles.is_one_fan(9));
  for (const auto& [a, b] : triangles.edges()) EXPECT_LE(triangles.sides(a, b).count, 2U);
}

TEST(EditableTriangles, PartsOfASplitEdgeAreOnItsLine) {
  EditableTriangles triangles(4);
  triangles.add({.nodes = {0, 1, 2}, .lines = {7, EditableTriangles::no_line, 5}});
  triangles.add({.nodes = {1, 0, 3}, .lines = {7, EditableTriangles::no_line, EditableTriangles::no_line}});
  const Index middle = triangles.add_node();
  triangles.split(0, 1, middle);
  EXPECT_EQ(count(triangles), 4);
  EXPECT_FALSE(triangles.is_edge(0, 1));
  EXPECT_EQ(triangles.line_of(0, middle), 7);
  EXPECT_EQ(triangles.line_of(1, middle), 7);
  EXPECT_EQ(triangles.line_of(middle, 2), EditableTriangles::no_line);
  EXPECT_EQ(triangles.line_of(0, 2), 5);
  EXPECT_EQ(triangles.neighbours(middle), (std::vector<Index>{0, 1, 2, 3}));
}

TEST(EditableTriangles, AFlipKeepsTheSenseAndTheLinesAround) {
  EditableTriangles triangles(4);
  triangles.add({.nodes = {0, 1, 2}, .lines = {EditableTriangles::no_line, 1, 2}});
  triangles.add({.nodes = {1, 0, 3}, .lines = {EditableTriangles::no_line, 3, 4}});
  ASSERT_TRUE(triangles.can_flip(0, 1));
  triangles.flip(0, 1);
  EXPECT_FALSE(triangles.is_edge(0, 1));
  EXPECT_EQ(triangles.sides(2, 3).count, 2U);
  EXPECT_EQ(triangles.line_of(1, 2), 1);
  EXPECT_EQ(triangles.line_of(2, 0), 2);
  EXPECT_EQ(triangles.line_of(0, 3), 3);
  EXPECT_EQ(triangles.line_of(3, 1), 4);
  for (const auto& [from, to] : {std::pair(1, 2), std::pair(2, 0), std::pair(0, 3), std::pair(3, 1)}) {
    const EditableTriangles::Sides sides = triangles.sides(from, to);
    EXPECT_EQ(triangles.triangle(sides.triangle[0]).node(sides.corner[0]), from);
  }
}

TEST(EditableTriangles, EdgesOnLinesAndOfTetrahedraDoNotFlip) {
  EditableTriangles triangles(4);
  triangles.add({.nodes = {0, 1, 2}, .lines = {1, -1, -1}});
  triangles.add({.nodes = {1, 0, 3}, .lines = {1, -1, -1}});
  EXPECT_FALSE(triangles.can_flip(0, 1));
  EditableTriangles tetrahedron(4);
  for (const auto& nodes : {std::array<Index, 3>{0, 1, 2}, {1, 0, 3}, {2, 3, 0}, {3, 2, 1}})
    tetrahedron.add({.nodes = nodes});
  EXPECT_FALSE(tetrahedron.can_flip(0, 1));
  EXPECT_FALSE(tetrahedron.can_collapse(0, 1));
}

TEST(EditableTriangles, ALineOfMoreTrianglesStaysOneWhenOthersComeToIt) {
  // Three triangles at the edge 0–1, of which one has a neighbour that collapses into it.
  EditableTriangles triangles(6);
  constexpr Index fixed = EditableTriangles::fixed_line;
  triangles.add({.nodes = {0, 1, 2}, .lines = {fixed, -1, -1}});
  triangles.add({.nodes = {0, 1, 3}, .lines = {fixed, -1, -1}});
  triangles.add({.nodes = {0, 1, 4}, .lines = {fixed, -1, -1}});
  triangles.add({.nodes = {0, 4, 5}, .lines = {-1, -1, -1}});
  triangles.collapse(4, 1);
  const EditableTriangles::Sides sides = triangles.sides(0, 1);
  EXPECT_EQ(sides.count, 3U);
  for (const Index number : triangles.around(0)) {
    const EditableTriangles::Triangle& triangle = triangles.triangle(number);
    const std::size_t k = triangle.place_of(0);
    if (triangle.node(k + 1) == 1) {
      EXPECT_EQ(triangle.line(k), fixed);
    }
  }
}

}  // namespace
}  // namespace vspring::editable_triangles_test
