
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/cancellation.hpp"
#include "base/random.hpp"
#include "equilibrium/newton.hpp"
#include "linear/lu_factor.hpp"
#include "spring/curve_net.hpp"
#include "support/surfaces.hpp"

namespace vspring::force_derivative_test {
namespace {

using namespace support;

Eigen::VectorXd displacements(Net& net, const Model& model, ThreadTeam& team) {
  update_directions(net, model, team);
  std::vector<NodeForce> forces(net.moving);
  model.find_forces(net, {0, net.moving}, forces);
  Eigen::VectorXd all(3 * static_cast<Eigen::Index>(net.moving));
  for (std::size_t i = 0; i < net.moving; ++i)
    all.segment<3>(3 * static_cast<Eigen::Index>(i)) = forces[i].spring + forces[i].regularisation;
  return all;
}

TEST(ForceDerivative, TellsHowAllDisplacementsChange) {
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh patch = generate::sphere_patch({.columns = 8, .rows = 8, .faces = faces, .jitter = 0.3}, 1, 60);
    // Held nodes with normals that are computed too.
    Constraints constraints(patch.node_count());
    fix_boundary_positions(constraints, patch);
    Net net = gather_net(generate::add_noise(patch, 0.02, 3), constraints);
    update_directions(net, *model, team);
    const std::vector<Vector3> positions = net.positions;
    const std::vector<Vector3> normals = net.normals;
    const Eigen::SparseMatrix<double> derivative = ForceDerivative(net, *model).find();
    EXPECT_EQ(net.positions, positions);
    EXPECT_EQ(net.normals, normals);

    Random random(1);
    Eigen::VectorXd way(derivative.cols());
    for (double& one : way) one = random.uniform(-1, 1);
    constexpr double step = 1e-6;
    const auto there = [&](double length) {
      for (std::size_t i = 0; i < net.moving; ++i)
        net.positions[i] = positions[i] + length * way.segment<3>(3 * static_cast<Eigen::Index>(i));
      return displacements(net, *model, team);
    };
    const Eigen::VectorXd change = (there(step) - there(-step)) / (2 * step);
    EXPECT_LT((derivative * way - change).norm(), 1e-6 * change.norm());
  }
}

TEST(ForceDerivative, OfCurvesIsABandInTheirOrder) {
  ThreadTeam team(1);
  const auto model = curve_model({});
  constexpr int count = 300;
  std::vector<Vector3> positions;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    positions.emplace_back(std::cos(angle), 0.7 * std::sin(angle), 0.1 * std::sin(3 * angle));
  }
  for (const bool is_closed : {false, true}) {
    const PolygonCurve curve(positions, is_closed);
    Constraints constraints(curve.node_count());
    for (const Index held : {0, 100, 299}) constraints.fix_position(held, curve.position(held));
    Net net = gather_net(curve, constraints);
    update_directions(net, *model, team);
    const Eigen::SparseMatrix<double> derivative = ForceDerivative(net, *model).find();
    EliminationOrder::PermutationType order;
    EliminationOrder()(derivative, order);
    for (int k = 0; k < order.size(); ++k) ASSERT_EQ(order.indices()[k], k) << is_closed;
  }
}

TEST(ForceDerivative, IsBrokenOffAndLeavesTheNet) {
  const auto model = surface_model(PseudoNormals::link);
  const PolygonMesh patch = generate::sphere_patch({.columns = 8, .rows = 8}, 1, 60);
  Net net = gather_net(patch, held_boundary(patch));
  ForceDerivative derivative(net, *model);
  const std::vector<Vector3> positions = net.positions;
  Context context;
  context.cancel();
  const CancellationScope scope(context);
  EXPECT_THROW((void)derivative.find(), Cancelled);
  EXPECT_EQ(net.positions, positions);
}

TEST(Newton, EndsWithTheStepInWhichItIsCancelled) {
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  const PolygonMesh patch = generate::add_noise(generate::sphere_patch({.columns = 8, .rows = 8}, 1, 60), 0.02, 3);
  for (const int step : {1, 3}) {
    Net net = gather_net(patch, held_boundary(patch));
    Context context;
    int steps = 0;
    EquilibriumTask task;
    task.tolerance = 1e-9;
    task.max_iterations = 100;
    task.on_iteration = [&](double /*size*/) {
      if (++steps == step) context.cancel();
    };
    const EquilibriumResult result = go_by_newton(net, *model, task, team, context);
    EXPECT_EQ(result.outcome, Outcome::cancelled);
    EXPECT_EQ(steps, step);
    for (const Vector3& position : net.positions) EXPECT_TRUE(position.allFinite());
  }
}

}  // namespace
}  // namespace vspring::force_derivative_test
