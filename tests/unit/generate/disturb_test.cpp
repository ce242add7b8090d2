#include <gtest/gtest.h>

#include <set>

#include "unit/generate/counted.hpp"
#include "vspring/generate.hpp"

namespace vspring::disturb_test {
namespace {

TEST(Noise, FillsABallAndLeavesTheBoundary) {
  const PolygonMesh mesh = generate::plane({.columns = 60, .rows = 60});
  const PolygonMesh noisy = generate::add_noise(mesh, 0.2, 7);
  EXPECT_EQ(noisy.corners(), mesh.corners());
  const auto boundary = count(mesh).boundaries.at(0);
  const std::set<Index> held(boundary.begin(), boundary.end());
  Vector3 sum = Vector3::Zero();
  double cubes = 0;
  int moved = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Vector3 move = noisy.position(i) - mesh.position(i);
    if (held.contains(i)) {
      EXPECT_EQ(move, Vector3(0, 0, 0));
      continue;
    }
    EXPECT_LE(move.norm(), 0.2 + 1e-15);
    ++moved;
    sum += move / 0.2;
    cubes += std::pow(move.norm() / 0.2, 3);
  }
  EXPECT_EQ(moved, 59 * 59);
  // In a ball the cube of the distance is uniform in 0 … 1 and a coordinate has variance 1/5: five standard deviations.
  EXPECT_NEAR(cubes / moved, 0.5, 5 / std::sqrt(12.0 * moved));
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis] / moved, 0, 5 / std::sqrt(5.0 * moved));
}

TEST(Noise, MovesTheBoundaryWhereAskedAndNothingWithoutAmplitude) {
  const PolygonMesh mesh = generate::plane();
  const PolygonMesh all = generate::add_noise(mesh, 0.1, 1, true);
  for (Index i = 0; i < mesh.node_count(); ++i) EXPECT_NE(all.position(i), mesh.position(i));
  EXPECT_EQ(generate::add_noise(mesh, 0).positions(), mesh.positions());
  EXPECT_EQ(generate::add_noise(mesh, 0.1, 4).positions(), generate::add_noise(mesh, 0.1, 4).positions());
  EXPECT_NE(generate::add_noise(mesh, 0.1, 4).positions(), generate::add_noise(mesh, 0.1, 5).positions());
}

TEST(Shuffle, IsTheSameMeshUnderOtherNumbers) {
  const PolygonMesh mesh = generate::plane({.columns = 13, .rows = 8, .faces = generate::Faces::mixed});
  const auto shuffled = generate::shuffle(mesh, 3);
  ASSERT_EQ(shuffled.mesh.node_count(), mesh.node_count());
  ASSERT_EQ(shuffled.mesh.face_count(), mesh.face_count());
  Index kept = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Index there = shuffled.new_number[static_cast<std::size_t>(i)];
    EXPECT_EQ(shuffled.mesh.position(there), mesh.position(i));
    kept += there == i ? 1 : 0;
  }
  EXPECT_LT(kept, 10);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto there = shuffled.mesh.face(shuffled.new_face_number[static_cast<std::size_t>(f)]);
    ASSERT_EQ(there.size(), mesh.face(f).size());
    for (std::size_t k = 0; k < there.size(); ++k)
      EXPECT_EQ(there[k], shuffled.new_number[static_cast<std::size_t>(mesh.face(f)[k])]);
  }
  EXPECT_EQ(generate::shuffle(mesh, 3).new_number, shuffled.new_number);
  EXPECT_NE(generate::shuffle(mesh, 4).new_number, shuffled.new_number);
  EXPECT_EQ(generate::shuffle(PolygonMesh()).mesh.node_count(), 0);
}

}  // namespace
}  // namespace vspring::disturb_test
