#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "vspring/constraints.hpp"
#include "vspring/generate.hpp"
#include "vspring/topology.hpp"

namespace vspring::normal_estimate_test {
namespace {

using generate::Faces;
using Exact = std::function<Vector3(const Vector3&)>;

std::vector<Index> all_nodes(const PolygonMesh& mesh) {
  std::vector<Index> nodes(static_cast<std::size_t>(mesh.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

// Greatest angle between estimate and truth, radians; at boundary nodes all neighbours lie on one side.
double greatest_error(const PolygonMesh& mesh, const Exact& exact) {
  const auto nodes = all_nodes(mesh);
  const auto normals = estimate_normals(mesh, nodes);
  double greatest = 0;
  for (const Index i : nodes) {
    const Vector3& normal = normals[static_cast<std::size_t>(i)];
    greatest = std::max(greatest,
                        std::atan2(normal.cross(exact(mesh.position(i))).norm(), normal.dot(exact(mesh.position(i)))));
  }
  return greatest;
}

TEST(EstimateNormals, AreExactOnSpheresAndPlanesAtBoundariesToo) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const generate::Grid grid{.columns = 9, .rows = 7, .faces = faces, .jitter = 0.4};
    EXPECT_LT(
        greatest_error(generate::sphere_patch(grid, 3, 80), [](const Vector3& p) -> Vector3 { return p.normalized(); }),
        1e-12);
    EXPECT_LT(greatest_error(generate::plane(grid, 3, 2), [](const Vector3&) { return Vector3(0, 0, 1); }), 1e-12);
  }
}

TEST(EstimateNormals, AreOfSecondOrderOnCylindersAndSaddles) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const auto cylinder = [&](int cells) {
      return greatest_error(
          generate::cylinder_patch({.columns = cells, .rows = cells, .faces = faces, .jitter = 0.3}, 1, 90, 1.5),
          [](const Vector3& p) -> Vector3 { return Vector3(p.x(), p.y(), 0).normalized(); });
    };
    const auto saddle = [&](int cells) {
      return greatest_error(generate::saddle({.columns = cells, .rows = cells, .faces = faces, .jitter = 0.3}, 1.5),
                            [](const Vector3& p) -> Vector3 { return Vector3(-p.y(), -p.x(), 1).normalized(); });
    };
    // The greatest of a random mesh's errors wavers; over three halvings second order is a factor of 64, first order
    // one of 8.
    EXPECT_GT(cylinder(10) / cylinder(80), 30) << static_cast<int>(faces);
    EXPECT_GT(saddle(10) / saddle(80), 30) << static_cast<int>(faces);
  }
}

TEST(EstimateNormals, LookAtUsableFacesOnly) {
  // A roof: z = −|x|. From one side only, its slope comes out, not the mean of both.
  PolygonMesh roof = generate::plane({.columns = 8, .rows = 8, .faces = Faces::quads}, 2, 2);
  std::vector<Vector3> positions = roof.positions();
  for (Vector3& p : positions) p.z() = -std::abs(p.x() - 1);
  roof.set_positions(positions);
  std::vector<std::uint8_t> right(static_cast<std::size_t>(roof.face_count()), 0);
  for (Index f = 0; f < roof.face_count(); ++f) {
    for (const Index i : roof.face(f)) {
      if (roof.position(i).x() > 1.01) right[static_cast<std::size_t>(f)] = 1;
    }
  }
  std::vector<Index> ridge;
  for (Index i = 0; i < roof.node_count(); ++i) {
    if (std::abs(roof.position(i).x() - 1) < 1e-9) ridge.push_back(i);
  }
  ASSERT_EQ(ridge.size(), 9U);
  for (const Vector3& normal : estimate_normals(roof, ridge, right))
    EXPECT_LT((normal - Vector3(1, 0, 1).normalized()).norm(), 1e-12);
  const std::vector<std::uint8_t> nothing(right.size(), 0);
  for (const Vector3& normal : estimate_normals(roof, ridge, nothing)) EXPECT_TRUE(normal.isZero(0));
}

TEST(EstimateNormals, OfAStripOneFaceWideAndOfALoneTriangle) {
  const PolygonMesh strip = generate::cylinder_patch({.columns = 20, .rows = 1, .faces = Faces::quads}, 1, 90, 0.1);
  EXPECT_LT(greatest_error(strip, [](const Vector3& p) -> Vector3 { return Vector3(p.x(), p.y(), 0).normalized(); }),
            0.05);
  const PolygonMesh triangle({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {0, 3}, {0, 1, 2});
  EXPECT_LT(greatest_error(triangle, [](const Vector3&) { return Vector3(0, 0, 1); }), 1e-12);
  const PolygonMesh tiny({{0, 0, 1e-200}, {1e-200, 0, 1e-200}, {0, 1e-200, 1e-200}}, {0, 3}, {0, 1, 2});
  EXPECT_LT(greatest_error(tiny, [](const Vector3&) { return Vector3(0, 0, 1); }), 1e-12);
}

}  // namespace
}  // namespace vspring::normal_estimate_test
