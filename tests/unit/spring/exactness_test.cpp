// Planes, spheres and cylinders are equilibria of V-Spring (Eq. 8) whatever the polygons, given exact normals; spheres
// also with Max's normals.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "spring/model.hpp"
#include "spring/net.hpp"
#include "spring/v_spring.hpp"
#include "vspring/generate.hpp"

namespace vspring::exactness_test {
namespace {

using generate::Faces;
using generate::Grid;

struct Case {
  std::string name;
  PolygonMesh mesh;
  std::function<Vector3(const Vector3&)> normal;
};

Vector3 radial(const Vector3& p) { return p.normalized(); }
Vector3 from_axis(const Vector3& p) { return Vector3(p.x(), p.y(), 0).normalized(); }
Vector3 up(const Vector3&) { return {0, 0, 1}; }

std::vector<Grid> grids() {
  std::vector<Grid> all;
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    for (const double jitter : {0.0, 0.4}) all.push_back({.columns = 16, .rows = 12, .faces = faces, .jitter = jitter});
  }
  return all;
}

std::string describe(const Grid& grid) {
  return "faces " + std::to_string(static_cast<int>(grid.faces)) + ", jitter " + std::to_string(grid.jitter);
}

std::vector<Case> cases(const Grid& grid) {
  return {{"plane", generate::plane(grid, 3, 2), up},
          {"sphere", generate::sphere_patch(grid, 2, 70), radial},
          {"cylinder", generate::cylinder_patch(grid, 2, 120, 3), from_axis}};
}

Constraints boundary_fixed(const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  return constraints;
}

double greatest_spring(const Net& net) {
  double greatest = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto force = node_force(i, net.rings.links(i), net.positions, net.normals, {}, net.tiny);
    greatest = std::max(greatest, force.spring.norm());
  }
  return greatest;
}

TEST(VSpring, IsAtRestOnPlanesSpheresAndCylindersWithExactNormals) {
  for (const Grid& grid : grids()) {
    for (const Case& shape : cases(grid)) {
      SCOPED_TRACE(shape.name + ", " + describe(grid));
      Constraints constraints = boundary_fixed(shape.mesh);
      for (Index i = 0; i < shape.mesh.node_count(); ++i)
        constraints.fix_normal(i, shape.normal(shape.mesh.position(i)));
      const Net net = gather_net(shape.mesh, constraints);
      ASSERT_GT(net.moving, 100U);
      EXPECT_LT(greatest_spring(net), 1e-12);
    }
  }
}

TEST(VSpring, IsAtRestOnSpheresWithNormalsAroundTheLink) {
  for (const Grid& grid : grids()) {
    SCOPED_TRACE(describe(grid));
    const PolygonMesh mesh = generate::sphere_patch(grid, 2, 70);
    Constraints constraints = boundary_fixed(mesh);
    for (Index i = 0; i < mesh.node_count(); ++i) {
      if (constraints.position_fixed(i)) constraints.fix_normal(i, radial(mesh.position(i)));
    }
    Net net = gather_net(mesh, constraints);
    ThreadTeam team(1);
    update_directions(net, *surface_model(PseudoNormals::link), team);
    EXPECT_LT(greatest_spring(net), 1e-12);
    // The paper's average is not exact where the mesh is irregular: the claim is one about the link.
    update_directions(net, *surface_model(PseudoNormals::average), team);
    if (grid.jitter > 0) {
      EXPECT_GT(greatest_spring(net), 1e-6);
    }
  }
}

TEST(VSpring, DifferenceIsThatOfTheSpringLengths) {
  // Two normals of a circle about (1, 2): P = H + t N, so t_j − t_i is known.
  const Vector3 centre(1, 2, 0);
  for (const double turn : {1e-9, 0.1, 1.0, 1.5}) {
    const Vector3 normal_i(1, 0, 0);
    const Vector3 normal_j(std::cos(turn), std::sin(turn), 0);
    const Vector3 d = (centre + 3.5 * normal_j) - (centre + 3 * normal_i);
    EXPECT_NEAR(spring_difference(d, normal_i, normal_j), 0.5, 1e-14);
    EXPECT_NEAR(spring_difference(d, normal_i, -normal_j), 0.5, 1e-14) << "the sense of a normal must not matter";
    EXPECT_NEAR(steady_difference(d, normal_i, normal_j), 0.5, 1e-14);
    EXPECT_NEAR(steady_difference(d, normal_i, -normal_j), 0.5, 1e-14);
  }
  // Skew normal lines: the feet of the common perpendicular lie 0.7 apart along z.
  const Vector3 skew(0, 0, 0.7);
  const Vector3 normal_j(std::cos(0.8), std::sin(0.8), 0);
  EXPECT_NEAR(spring_difference(skew + 2.25 * normal_j - Vector3(2, 0, 0), {1, 0, 0}, normal_j), 0.25, 1e-14);
}

TEST(VSpring, TheForceChangesOverByDegreesWhereNormalsAreAtARightAngle) {
  const Vector3 d(0.3, 0.8, -0.2);
  const Vector3 normal_i(1, 0, 0);
  const auto difference = [&](double turn, double sense) {
    return steady_difference(d, normal_i, sense * Vector3(std::cos(turn), std::sin(turn), 0));
  };
  constexpr double right = std::numbers::pi / 2;
  constexpr double step = 1e-4;
  for (int k = -1000; k < 1000; ++k) {
    const double turn = right + k * step;
    EXPECT_NEAR(difference(turn, 1), difference(turn + step, 1), 16 * step);
    EXPECT_DOUBLE_EQ(difference(turn, 1), difference(turn, -1)) << "the sense of a normal must not matter";
  }
}

}  // namespace
}  // namespace vspring::exactness_test
