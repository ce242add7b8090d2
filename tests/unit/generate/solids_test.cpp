#include <gtest/gtest.h>

#include "unit/generate/counted.hpp"
#include "vspring/generate.hpp"
#include "vspring/sharp_edges.hpp"

namespace vspring::solids_test {
namespace {

using generate::Faces;
using generate::Side;

TEST(PipeBlend, EndsInExactCirclesWhicheverPipesThereAre) {
  for (unsigned chosen = 0; chosen < 64; ++chosen) {
    std::vector<Side> pipes;
    for (int side = 0; side < 6; ++side) {
      if ((chosen >> side & 1U) != 0) pipes.push_back(static_cast<Side>(side));
    }
    if (pipes.size() < 2) continue;
    for (const Faces faces : {Faces::quads, Faces::triangles}) {
      SCOPED_TRACE(testing::Message() << "pipes " << chosen << ", faces " << static_cast<int>(faces));
      const PolygonMesh mesh = generate::pipe_blend(
          {.pipes = pipes, .cells = 3, .side = 2, .pipe_radius = 0.8, .pipe_length = 1.5, .faces = faces});
      const Counted counted = count(mesh);
      EXPECT_EQ(counted.euler(), 2 - static_cast<Index>(pipes.size()));
      EXPECT_TRUE(counted.oriented);
      EXPECT_EQ(counted.isolated_nodes, 0);
      ASSERT_EQ(counted.boundaries.size(), pipes.size());
      for (const auto& loop : counted.boundaries) {
        EXPECT_EQ(loop.size(), 12U);
        Index axis = 0;
        mesh.position(loop[0]).cwiseAbs().maxCoeff(&axis);
        for (const Index node : loop) {
          Vector3 p = mesh.position(node);
          EXPECT_EQ(std::abs(p[axis]), 2.5);
          p[axis] = 0;
          EXPECT_NEAR(p.norm(), 0.8, 1e-15);
        }
      }
      for (Index f = 0; f < mesh.face_count(); ++f) EXPECT_EQ(mesh.face(f).size(), faces == Faces::quads ? 4U : 3U);
      // Outward: from the axis where a pipe is round, from the centre on the sides of the cube.
      for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vector3 middle = face_middle(mesh, f);
        Index axis = 0;
        const double furthest = middle.cwiseAbs().maxCoeff(&axis);
        Vector3 outward = middle;
        if (furthest > 1.75) outward[axis] = 0;
        if (furthest > 1.75 || furthest < 1 + 1e-12) {
          EXPECT_GT(face_vector(mesh, f).dot(outward), 0) << f;
        }
      }
    }
  }
}

TEST(PipeBlend, HasTheNodesThatItsNumbersSay) {
  // Two opposite pipes: four sides of the cube, of 5 × 20 nodes, and two pipes of 2 · 3 rows each.
  const PolygonMesh mesh =
      generate::pipe_blend({.pipes = {Side::plus_z, Side::minus_z}, .cells = 5, .pipe_length = 1.2});
  EXPECT_EQ(mesh.node_count(), 20 * 6 + 2 * 6 * 20);
  EXPECT_EQ(mesh.face_count(), 4 * 25 + 2 * 6 * 20);
}

TEST(Hull, HasTwoChinesAndAKeelInThePlane) {
  for (const Faces faces : {Faces::quads, Faces::triangles}) {
    const PolygonMesh half = generate::hull({.columns = 60, .rows = 18, .faces = faces});
    EXPECT_EQ(half.node_count(), 61 * 19);
    const Counted counted = count(half);
    EXPECT_TRUE(counted.oriented);
    EXPECT_EQ(counted.euler(), 1);
    ASSERT_EQ(counted.boundaries.size(), 1U);
    EXPECT_EQ(half.position(60).y(), 0);
    EXPECT_EQ(half.position(61 * 19 - 1), Vector3(10, 0, 1.5 * 0.86));
    EXPECT_EQ(half.position(61 * 18).y(), 1.5);
    for (Index f = 0; f < half.face_count(); ++f) EXPECT_GT(face_vector(half, f).y(), 0);
    if (faces != Faces::quads) continue;
    // The chines alone are sharp, to where they run out near the stem.
    const SharpEdges sharp = find_sharp_edges(half, 15);
    ASSERT_EQ(sharp.chains.chains().size(), 2U);
    for (const PolygonCurve::Chain& chain : sharp.chains.chains()) {
      EXPECT_GT(chain.nodes.size(), 50U);
      const Index row = chain.nodes[0] / 61;
      EXPECT_TRUE(row == 6 || row == 12);
      for (const Index node : chain.nodes) EXPECT_EQ(node / 61, row);
    }
  }
}

TEST(Hull, BothSidesAreMirrorImages) {
  const PolygonMesh half = generate::hull({.columns = 12, .rows = 6});
  const PolygonMesh whole = generate::hull({.columns = 12, .rows = 6, .whole = true});
  const Index in_plane = 13 + 6;
  EXPECT_EQ(whole.node_count(), 2 * half.node_count() - in_plane);
  EXPECT_EQ(whole.face_count(), 2 * half.face_count());
  const Counted counted = count(whole);
  EXPECT_TRUE(counted.oriented);
  EXPECT_EQ(counted.boundaries.size(), 1U);
  Index next = half.node_count();
  for (Index i = 0; i < half.node_count(); ++i) {
    const Vector3& p = half.position(i);
    EXPECT_EQ(whole.position(i), p);
    if (p.y() != 0) EXPECT_EQ(whole.position(next++), Vector3(p.x(), -p.y(), p.z()));
  }
}

double volume(const PolygonMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) sum += face_vector(mesh, f).dot(face_middle(mesh, f)) / 3;
  return sum;
}

TEST(Genus, HasThatManyHoles) {
  for (const int holes : {0, 1, 2, 3, 7}) {
    for (const int cells : {1, 2, 5}) {
      SCOPED_TRACE(testing::Message() << holes << " holes, " << cells << " cells");
      const PolygonMesh mesh = generate::genus({.holes = holes, .cells = cells, .side = 2});
      const Counted counted = count(mesh);
      EXPECT_EQ(counted.euler(), 2 - 2 * holes);
      EXPECT_TRUE(counted.oriented);
      EXPECT_TRUE(counted.boundaries.empty());
      EXPECT_EQ(counted.isolated_nodes, 0);
      EXPECT_EQ(counted.faces, (18 * holes + 14) * cells * cells);
      EXPECT_NEAR(volume(mesh), 8.0 * (3 * (2 * holes + 1) - holes), 1e-10);
    }
  }
}

TEST(PolygonPatch, HasOnePolygonAmidQuads) {
  for (const int sides : {3, 4, 5, 7, 8, 9, 12, 100}) {
    for (const int rings : {1, 2, 5}) {
      for (const double half_angle : {0.0, 70.0}) {
        SCOPED_TRACE(testing::Message() << sides << " sides, " << rings << " rings");
        const PolygonMesh mesh =
            generate::polygon_patch({.sides = sides, .rings = rings, .radius = 2, .half_angle = half_angle});
        const Counted counted = count(mesh);
        EXPECT_EQ(counted.euler(), 1);
        EXPECT_TRUE(counted.oriented);
        EXPECT_EQ(counted.isolated_nodes, 0);
        const auto polygon = mesh.face(0);
        ASSERT_EQ(polygon.size(), static_cast<std::size_t>(sides));
        for (int k = 0; k < sides; ++k) EXPECT_EQ(polygon[static_cast<std::size_t>(k)], k);
        for (Index f = 1; f < mesh.face_count(); ++f) EXPECT_EQ(mesh.face(f).size(), 4U);
        EXPECT_EQ(mesh.face_count(), 1 + sides * rings * (sides <= 8 ? rings + 1 : 1));
        ASSERT_EQ(counted.boundaries.size(), 1U);
        EXPECT_EQ(counted.boundary_nodes(), sides * (sides <= 8 ? 2 * rings + 1 : 1));
        for (const Index node : counted.boundaries[0]) {
          EXPECT_NEAR(mesh.position(node).norm(), 2, 2e-15);
          EXPECT_EQ(mesh.position(node).z(), 0);
        }
        const Index inside = mesh.node_count() - counted.boundary_nodes();
        for (Index i = 0; i < inside; ++i)
          EXPECT_EQ(counted.degrees[static_cast<std::size_t>(i)], sides > 8 && i < sides ? 3 : 4);
        EXPECT_GT(least_outwardness(mesh, [](const Vector3&) { return Vector3(0, 0, 1); }), 0.2);
      }
    }
  }
}

TEST(PolygonPatch, LiesOnItsSphere) {
  for (const double half_angle : {10.0, 90.0, 150.0}) {
    const double angle = half_angle * std::numbers::pi / 180;
    const double sphere = 2 / std::sin(angle);
    const Vector3 centre(0, 0, -sphere * std::cos(angle));
    const PolygonMesh mesh = generate::polygon_patch({.radius = 2, .half_angle = half_angle});
    EXPECT_LT(greatest_deviation(mesh, [&](const Vector3& p) { return (p - centre).norm() / sphere - 1; }), 1e-15);
  }
  EXPECT_EQ(greatest_deviation(generate::polygon_patch({.sides = 7}), [](const Vector3& p) { return p.z(); }), 0);
}

TEST(PolygonPatch, OfFourSidesIsASquareGridInTheMiddle) {
  const Counted counted = count(generate::polygon_patch({.sides = 4, .rings = 3}));
  EXPECT_EQ(counted.faces, 49);
  EXPECT_EQ(counted.nodes, 64);
}

}  // namespace
}  // namespace vspring::solids_test
