// Figures of fairness against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "vspring/vspring.hpp"

namespace vspring::fairness_test {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

PolygonMesh cube() {
  MeshBuilder builder;
  for (int k = 0; k < 8; ++k) builder.add_node({double(k & 1), double((k >> 1) & 1), double((k >> 2) & 1)});
  builder.add_face({0, 2, 3, 1});
  builder.add_face({4, 5, 7, 6});
  builder.add_face({0, 1, 5, 4});
  builder.add_face({2, 6, 7, 3});
  builder.add_face({0, 4, 6, 2});
  builder.add_face({1, 3, 7, 5});
  return builder.take();
}

PolygonMesh octahedron() {
  MeshBuilder builder;
  for (const double sign : {1.0, -1.0}) {
    for (int axis = 0; axis < 3; ++axis) builder.add_node(sign * Vector3::Unit(axis));
  }
  for (const auto& face :
       {std::array{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}})
    builder.add_face(std::array<Index, 3>{face[0], face[1], face[2]});
  return builder.take();
}

TEST(Fairness, TurnsOfTheRegularSolids) {
  const Fairness of_cube = measure(cube());
  EXPECT_NEAR(of_cube.greatest_turn, 90, 1e-12);
  EXPECT_NEAR(of_cube.rms_turn, 90, 1e-12);
  const Fairness of_octahedron = measure(octahedron());
  const double turn = degrees * std::acos(1.0 / 3);
  EXPECT_NEAR(of_octahedron.greatest_turn, turn, 1e-12);
  EXPECT_NEAR(of_octahedron.rms_turn, turn, 1e-12);
}

TEST(Fairness, TheSenseOfAFaceDoesNotMatter) {
  for (const PolygonMesh& mesh : {cube(), generate::torus({.columns = 24, .rows = 12}, 2, 1)}) {
    std::vector<Index> corners = mesh.corners();
    std::reverse(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(mesh.face(0).size()));
    const Fairness turned = measure(PolygonMesh(mesh.positions(), mesh.face_begin(), corners));
    EXPECT_NEAR(turned.greatest_turn, measure(mesh).greatest_turn, 1e-10);
    EXPECT_NEAR(turned.rms_turn, measure(mesh).rms_turn, 1e-10);
    EXPECT_NEAR(turned.vspring_energy, measure(mesh).vspring_energy, 1e-10);
  }
}

TEST(Fairness, SpheresAndPlanesHaveNoEnergy) {
  const PolygonMesh torus = generate::torus({.columns = 24, .rows = 12}, 2, 1);
  EXPECT_GT(measure(torus).vspring_energy, 1e-4);
  EXPECT_LT(measure(cube()).vspring_energy, 1e-28);
  EXPECT_LT(measure(octahedron()).vspring_energy, 1e-28);
}

TEST(Fairness, EnergyFallsWithTheSquareOfTheSpacing) {
  // Per edge ((t_j − t_i)/ℓ)² goes with ℓ⁴, and the number of edges with 1/ℓ².
  const auto energy = [](int cells) {
    // Stretched, because on the round torus every edge joins nodes that mirror each other and no spring disagrees.
    PolygonMesh torus = generate::torus({.columns = 2 * cells, .rows = cells, .faces = generate::Faces::quads}, 2, 1);
    std::vector<Vector3> positions = torus.positions();
    for (Vector3& position : positions) position.x() *= 1.5;
    torus.set_positions(positions);
    return measure(torus).vspring_energy;
  };
  EXPECT_NEAR(energy(40) / energy(80), 4, 0.1);
}

TEST(Fairness, WithConstraintsOnlyTheMovingPartCounts) {
  PolygonMesh mesh = generate::plane({.columns = 20, .rows = 20, .faces = generate::Faces::quads}, 1, 1);
  std::vector<Vector3> positions = mesh.positions();
  positions[0].z() = 1;  // a crease at a corner that is held
  mesh.set_positions(positions);
  Constraints constraints(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) constraints.fix_position(i, mesh.position(i));
  Index middle = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if ((mesh.position(i) - Vector3(0.5, 0.5, 0)).norm() < 1e-9) middle = i;
  }
  constraints.free_position(middle);
  EXPECT_GT(measure(mesh).greatest_turn, 10);
  EXPECT_LT(measure(mesh, &constraints).greatest_turn, 1e-9);
}

TEST(Fairness, FacesWithoutAreaAreLeftOut) {
  const PolygonMesh flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {0, 3, 6}, {0, 1, 2, 0, 2, 3});
  const Fairness fairness = measure(flat);
  EXPECT_EQ(fairness.greatest_turn, 0);
  EXPECT_TRUE(std::isfinite(fairness.vspring_energy));
}

}  // namespace
}  // namespace vspring::fairness_test
