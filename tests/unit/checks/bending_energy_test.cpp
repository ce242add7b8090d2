#include "checks/bending_energy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "spring/model.hpp"
#include "support/surfaces.hpp"

namespace vspring::bending_energy_test {
namespace {

using namespace support;

Net net_of(const PolygonMesh& mesh, const Constraints& constraints) {
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  Net net = gather_net(mesh, constraints, true);
  update_directions(net, *model, team);
  return net;
}

TEST(BendingEnergy, OfATorusIsThatOfItsPrincipalCurvatures) {
  ThreadTeam team(1);
  // ∫ κ₁² + κ₂² = ∫ 4H² − 2K = 4 π² R²/(r √(R² − r²)), and ∫ K = 0.
  const double exact = 4 * std::numbers::pi * std::numbers::pi * 9 / std::sqrt(8.0);
  for (const generate::Faces faces : every_kind) {
    const auto error = [&](int rows) {
      const PolygonMesh mesh = generate::torus({.columns = 3 * rows, .rows = rows, .faces = faces}, 3, 1);
      Constraints constraints(mesh.node_count());
      for (const Index node : {0, 1, 2, 3}) constraints.fix_position(node, mesh.position(node));
      const Net net = net_of(mesh, constraints);
      return std::abs(BendingEnergy(net).of(net.positions, team) / exact - 1);
    };
    EXPECT_LT(error(32), 0.05);
    EXPECT_LT(error(32), 0.5 * error(16));
  }
}

TEST(BendingEnergy, CountsWhereASurfaceLeavesAGivenNormal) {
  ThreadTeam team(1);
  const PolygonMesh mesh = generate::plane({.columns = 8, .rows = 8});
  const auto energy = [&](double slope) {
    const Net net = net_of(mesh, held_boundary(mesh, [&](const Vector3&) { return Vector3(slope, 0, 1); }));
    return BendingEnergy(net).of(net.positions, team);
  };
  EXPECT_LT(energy(0), 1e-20);
  EXPECT_GT(energy(0.2), 1);
  const Net free = net_of(mesh, held_boundary(mesh));
  EXPECT_LT(BendingEnergy(free).of(free.positions, team), 1e-20);
}

TEST(BendingEnergy, ItsDerivativesAreThoseOfDifferences) {
  ThreadTeam team(2);
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh plane = generate::plane({.columns = 8, .rows = 8, .faces = faces});
    for (const double noise : {0.0, 0.02}) {
      const PolygonMesh mesh = generate::add_noise(plane, noise, 3);
      const Net net = net_of(mesh, clamped_boundary(mesh));
      const BendingEnergy bending(net);
      const std::vector<double> slopes = bending.slopes(net.positions, team);
      Eigen::VectorXd moves(static_cast<Eigen::Index>(net.moving));
      double slope = 0;
      for (std::size_t i = 0; i < net.moving; ++i) {
        moves[static_cast<Eigen::Index>(i)] = std::sin(3.0 * static_cast<double>(i));
        slope += slopes[i] * moves[static_cast<Eigen::Index>(i)];
      }
      const auto at = [&](double way) {
        std::vector<Vector3> positions = net.positions;
        for (std::size_t i = 0; i < net.moving; ++i)
          positions[i] += way * moves[static_cast<Eigen::Index>(i)] * net.normals[i];
        return bending.of(positions, team);
      };
      const double way = 1e-5;
      EXPECT_NEAR(slope, (at(way) - at(-way)) / (2 * way), 1e-4 * std::abs(slope) + 1e-6);
      if (noise > 0) continue;
      // Of a flat surface quadratics are all there is.
      const Eigen::VectorXd bent = bending.second_derivative(net.positions).selfadjointView<Eigen::Lower>() * moves;
      EXPECT_NEAR(moves.dot(bent) / (2 * at(way) / (way * way)), 1, 1e-3);
    }
  }
}

}  // namespace
}  // namespace vspring::bending_energy_test
