#include <gtest/gtest.h>

#include <set>

#include "support/surfaces.hpp"
#include "unit/generate/counted.hpp"
#include "vspring/generate.hpp"

namespace vspring::grids_test {
namespace {

using generate::Faces;
using generate::Grid;
using support::every_kind;

Vector3 up(const Vector3&) { return {0, 0, 1}; }
Vector3 from_origin(const Vector3& p) { return p; }
Vector3 from_axis(const Vector3& p) { return {p.x(), p.y(), 0}; }

TEST(Grids, PlanesOfEveryKindAreWholeAndFaceUp) {
  for (const Faces faces : every_kind) {
    for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(2, 3), std::pair(7, 4), std::pair(13, 9)}) {
      for (const double jitter : {0.0, 0.5}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(faces) << ": " << columns << " × " << rows << ", "
                                        << jitter);
        const PolygonMesh mesh =
            generate::plane({.columns = columns, .rows = rows, .faces = faces, .jitter = jitter}, 3, 2);
        const Counted counted = count(mesh);
        EXPECT_EQ(counted.nodes, (columns + 1) * (rows + 1));
        EXPECT_EQ(counted.euler(), 1);
        EXPECT_EQ(counted.isolated_nodes, 0);
        EXPECT_TRUE(counted.oriented);
        ASSERT_EQ(counted.boundaries.size(), 1U);
        EXPECT_EQ(counted.boundary_nodes(), 2 * (columns + rows));
        EXPECT_GT(least_outwardness(mesh, up), 0.999);
        double area = 0;
        for (Index f = 0; f < mesh.face_count(); ++f) area += face_vector(mesh, f).z();
        EXPECT_NEAR(area, 6, 1e-13);
      }
    }
  }
}

TEST(Grids, NodesGoRowByRowFromTheOrigin) {
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 3}, 8, 3);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Index row = i / 5;
    EXPECT_EQ(mesh.position(i), Vector3(2 * (i % 5), row, 0));
  }
}

TEST(Grids, TrianglesPreferNoDirection) {
  const PolygonMesh mesh = generate::plane({.columns = 6, .rows = 4, .faces = Faces::triangles}, 6, 4);
  EXPECT_EQ(mesh.face_count(), 48);
  std::set<std::pair<Index, Index>> rising;
  std::set<std::pair<Index, Index>> falling;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto nodes = mesh.face(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [from, to] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      const Vector3 edge = mesh.position(to) - mesh.position(from);
      if (edge.x() * edge.y() > 0) rising.emplace(from, to);
      if (edge.x() * edge.y() < 0) falling.emplace(from, to);
    }
  }
  EXPECT_EQ(rising.size(), 12U);
  EXPECT_EQ(falling.size(), 12U);
}

TEST(Grids, EveryFourByFourCellsOfAMixedGridHoldAllKindsOfFaces) {
  const int cells = 11;
  const PolygonMesh mesh = generate::plane({.columns = cells, .rows = cells, .faces = Faces::mixed}, cells, cells);
  for (int left = 0; left + 4 <= cells; ++left) {
    for (int low = 0; low + 4 <= cells; ++low) {
      std::set<std::size_t> sizes;
      for (Index f = 0; f < mesh.face_count(); ++f) {
        Eigen::AlignedBox<double, 3> block(Vector3(left, low, 0), Vector3(left + 4, low + 4, 0));
        bool within = true;
        for (const Index node : mesh.face(f)) within = within && block.contains(mesh.position(node));
        if (within) sizes.insert(mesh.face(f).size());
      }
      EXPECT_EQ(sizes, (std::set<std::size_t>{3, 4, 6})) << left << ' ' << low;
    }
  }
}

TEST(Grids, HexagonsLeaveThreeEdgesAtNodesInside) {
  const PolygonMesh mesh = generate::plane({.columns = 9, .rows = 8, .faces = Faces::hexagons});
  const Counted counted = count(mesh);
  std::set<Index> boundary(counted.boundaries[0].begin(), counted.boundaries[0].end());
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!boundary.contains(i)) {
      EXPECT_EQ(counted.degrees[static_cast<std::size_t>(i)], 3) << i;
    }
  }
  const PolygonMesh torus = generate::torus({.columns = 12, .rows = 6, .faces = Faces::hexagons});
  EXPECT_EQ(torus.face_count(), 36);
  for (const Index degree : count(torus).degrees) EXPECT_EQ(degree, 3);
}

TEST(Grids, JitteredNodesLieOnTheirShapesExactly) {
  const auto from_cylinder = [](const Vector3& p) { return std::hypot(p.x(), p.y()) - 3; };
  for (const Faces faces : every_kind) {
    const Grid grid{.columns = 24, .rows = 16, .faces = faces, .jitter = 0.5, .seed = 5};
    const auto from_sphere = [](const Vector3& p) { return p.norm() - 3; };
    EXPECT_LT(greatest_deviation(generate::sphere_patch(grid, 3, 150), from_sphere), 3e-15);
    EXPECT_LT(greatest_deviation(generate::cylinder_patch(grid, 3, 300, 4), from_cylinder), 3e-15);
    EXPECT_LT(greatest_deviation(generate::tube(grid, 3, 4), from_cylinder), 3e-15);
    const auto from_torus = [](const Vector3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 3, p.z()) - 1; };
    EXPECT_LT(greatest_deviation(generate::torus(grid, 3, 1), from_torus), 4e-15);
    const auto from_saddle = [](const Vector3& p) { return p.z() - p.x() * p.y(); };
    EXPECT_EQ(greatest_deviation(generate::saddle(grid, 2), from_saddle), 0);
    EXPECT_EQ(greatest_deviation(generate::plane(grid, 2, 3), [](const Vector3& p) { return p.z(); }), 0);
  }
}

TEST(Grids, FacesLookOutwards) {
  for (const Faces faces : every_kind) {
    for (const double jitter : {0.0, 0.3}) {
      const Grid grid{.columns = 24, .rows = 16, .faces = faces, .jitter = jitter};
      EXPECT_GT(least_outwardness(generate::sphere_patch(grid, 2, 120), from_origin), 0.9);
      EXPECT_GT(least_outwardness(generate::cylinder_patch(grid, 2, 200, 3), from_axis), 0.9);
      EXPECT_GT(least_outwardness(generate::tube(grid, 2, 3), from_axis), 0.9);
      EXPECT_GT(least_outwardness(generate::saddle(grid, 1), up), 0.5);
      const auto from_ring = [](const Vector3& p) -> Vector3 { return p - 2 * from_axis(p).normalized(); };
      EXPECT_GT(least_outwardness(generate::torus(grid, 2, 1), from_ring), 0.8);
    }
  }
}

TEST(Grids, JitterLeavesTheBoundaryAndMovesAllElse) {
  const Grid even{.columns = 8, .rows = 5};
  Grid jittered = even;
  jittered.jitter = 0.4;
  for (const bool around : {false, true}) {
    const PolygonMesh before = around ? generate::tube(even) : generate::plane(even);
    const PolygonMesh after = around ? generate::tube(jittered) : generate::plane(jittered);
    const Counted counted = count(before);
    std::set<Index> boundary;
    for (const auto& loop : counted.boundaries) boundary.insert(loop.begin(), loop.end());
    for (Index i = 0; i < before.node_count(); ++i)
      EXPECT_EQ(before.position(i) == after.position(i), boundary.contains(i)) << i;
  }
  const auto torus = generate::torus(even).positions();
  const auto moved = generate::torus(jittered).positions();
  for (std::size_t i = 0; i < torus.size(); ++i) EXPECT_NE(torus[i], moved[i]);
}

TEST(Grids, ToriCloseBothWaysAndTubesOneWay) {
  for (const Faces faces : every_kind) {
    const bool mixed = faces == Faces::mixed;
    for (const auto& [columns, rows] :
         {std::pair(4, 4), std::pair(12, 8), std::pair(mixed ? 20 : 10, mixed ? 12 : 6)}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(faces) << ": " << columns << " × " << rows);
      const Counted torus = count(generate::torus({.columns = columns, .rows = rows, .faces = faces}));
      EXPECT_EQ(torus.nodes, columns * rows);
      EXPECT_EQ(torus.euler(), 0);
      EXPECT_TRUE(torus.oriented);
      EXPECT_TRUE(torus.boundaries.empty());
      EXPECT_EQ(torus.isolated_nodes, 0);
      const Counted tube = count(generate::tube({.columns = columns, .rows = rows - 1, .faces = faces}));
      EXPECT_EQ(tube.nodes, columns * rows);
      EXPECT_EQ(tube.euler(), 0);
      EXPECT_TRUE(tube.oriented);
      ASSERT_EQ(tube.boundaries.size(), 2U);
      EXPECT_EQ(tube.boundary_nodes(), 2 * columns);
      EXPECT_EQ(tube.isolated_nodes, 0);
    }
  }
  EXPECT_EQ(count(generate::torus({.columns = 3, .rows = 3})).euler(), 0);
}

TEST(Grids, PatchesSpanTheirAnglesAndSizes) {
  const Grid grid{.columns = 10, .rows = 6};
  const PolygonMesh sphere = generate::sphere_patch(grid, 2, 90);
  EXPECT_LT((sphere.position(3 * 11 + 5) - Vector3(0, 0, 2)).norm(), 1e-15);
  const double half = std::sqrt(2.0);
  EXPECT_LT((sphere.position(3 * 11) - Vector3(-half, 0, half)).norm(), 1e-15);
  EXPECT_LT((sphere.position(6 * 11 + 5) - Vector3(0, half, half)).norm(), 1e-15);
  const PolygonMesh cylinder = generate::cylinder_patch(grid, 2, 180, 3);
  EXPECT_LT((cylinder.position(0) - Vector3(0, -2, 0)).norm(), 1e-15);
  EXPECT_LT((cylinder.position(6 * 11 + 10) - Vector3(0, 2, 3)).norm(), 1e-15);
}

TEST(Grids, OneSeedGivesTheSameBits) {
  const Grid grid{.jitter = 0.3, .seed = 17};
  Grid other = grid;
  other.seed = 18;
  EXPECT_EQ(generate::plane(grid).positions(), generate::plane(grid).positions());
  EXPECT_NE(generate::plane(grid).positions(), generate::plane(other).positions());
}

}  // namespace
}  // namespace vspring::grids_test
