#include "equilibrium/bending_descent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "checks/bending_energy.hpp"
#include "checks/result_check.hpp"
#include "support/surfaces.hpp"

namespace vspring::bending_descent_test {
namespace {

using namespace support;

TEST(BendingDescent, BendsAndFoldsNoMore) {
  ThreadTeam team(1);
  Context context;
  const auto model = surface_model(PseudoNormals::link);
  for (const generate::Faces faces : every_kind) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      // Long cells with noise of half their width; normals of such a rim ask for a crumpled surface.
      const PolygonMesh tube =
          generate::add_noise(generate::tube({.columns = 8, .rows = 16, .faces = faces}, 1, 1.5), 0.05, seed, true);
      Net net = gather_net(tube, clamped_boundary(tube), true);
      const BendingEnergy bending(net);
      const double before = bending.of(net.positions, team);
      const std::size_t turned = turned_edges(net, team);
      EquilibriumTask task;
      task.max_iterations = 30;
      (void)descend_bending(net, *model, task, team, context);
      EXPECT_LE(turned_edges(net, team), turned);
      EXPECT_LE(bending.of(net.positions, team), before);
    }
  }
}

TEST(BendingDescent, FlattensASquareToTheTolerance) {
  ThreadTeam team(1);
  Context context;
  const auto model = surface_model(PseudoNormals::link);
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh mesh = generate::add_noise(generate::plane({.columns = 12, .rows = 12, .faces = faces}), 0.03, 3);
    Net net = gather_net(mesh, held_boundary(mesh), true);
    EquilibriumTask task;
    task.tolerance = 1e-6;
    const EquilibriumResult result = descend_bending(net, *model, task, team, context);
    EXPECT_EQ(result.outcome, Outcome::converged);
    const double plane = net.positions.back().z();
    for (const Vector3& p : net.positions) EXPECT_NEAR(p.z(), plane, 3 * result.expected_error);
  }
}

TEST(BendingDescent, DrawnToItsStartItKeepsHalfOfWavesOfTheSmoothingLength) {
  ThreadTeam team(1);
  Context context;
  const auto model = surface_model(PseudoNormals::link);
  constexpr double waves = 4;
  constexpr double height = 1e-3;
  const double frequency = 2 * std::acos(-1.0) * waves;
  const PolygonMesh plane = generate::plane({.columns = 64, .rows = 64});
  std::vector<Vector3> positions = plane.positions();
  for (Vector3& p : positions) p.z() = height * std::cos(frequency * p.x());
  const PolygonMesh wavy = with_positions(plane, positions);
  Net net = gather_net(wavy, clamped_boundary(wavy), true);
  const std::vector<Vector3> start = net.positions;
  const double half = net.frame.scale() / 2;
  EquilibriumTask task;
  task.tolerance = 1e-9;
  task.home = start;
  task.smoothing_length = net.frame.scale() / frequency;
  const EquilibriumResult result = descend_bending(net, *model, task, team, context);
  EXPECT_EQ(result.outcome, Outcome::converged);
  for (std::size_t i = 0; i < net.moving; ++i) {
    // The boundary is held where it is.
    if ((start[i] - net.frame.to_local({0.5, 0.5, 0})).head<2>().lpNorm<Eigen::Infinity>() > half / 2) continue;
    EXPECT_NEAR(net.positions[i].z(), start[i].z() / 2, 0.05 * height * net.frame.scale());
  }
}

}  // namespace
}  // namespace vspring::bending_descent_test
