// Forces as the paper prints them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "spring/v_spring.hpp"
#include "support/curves.hpp"
#include "support/surfaces.hpp"

namespace vspring::printed_forces_test {
namespace {

using namespace support;

constexpr Block first_node = {0, 1};

/// Eqs. 4, 5 and 8, written down once more.
double by_hand(const Net& net, std::size_t i) {
  double displacements = 0;
  double weights = 0;
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    const Vector3 d = net.positions[link.node()] - net.positions[i];
    const Vector3 other = net.normals[link.node()];
    const Vector3 turned = other.dot(net.normals[i]) < 0 ? Vector3(-other) : other;
    displacements += d.dot(net.normals[i] + turned) / (1 + net.normals[i].dot(turned)) / d.norm();
    weights += 1 / d.norm();
  }
  return displacements / weights;
}

TEST(PrintedForces, AreEquation8WithNormalsThatTurnAtARightAngle) {
  const PolygonMesh bumpy =
      generate::add_noise(generate::plane({.columns = 6, .rows = 6, .faces = generate::Faces::mixed}), 0.02, 3);
  Net net = gather_net(bumpy, held_boundary(bumpy));
  ThreadTeam team(1);
  const auto printed = surface_model(PseudoNormals::average, Forces::printed);
  const auto steady = surface_model(PseudoNormals::average);
  update_directions(net, *printed, team);
  // Two neighbours that face each other nearly at a right angle.
  net.normals[0] = Vector3::UnitZ();
  const std::size_t beside = net.rings.links(0).front().node();
  net.normals[beside] = Vector3(1, 0, -0.01).normalized();
  std::vector<NodeForce> force(1);
  printed->find_forces(net, first_node, force);
  EXPECT_NEAR(force[0].spring.dot(net.normals[0]), by_hand(net, 0), 1e-12);
  steady->find_forces(net, first_node, force);
  EXPECT_GT(std::abs(force[0].spring.dot(net.normals[0]) - by_hand(net, 0)), 1e-3);
}

TEST(PrintedForces, DoInFullWhatPointsAskFor) {
  const PolygonMesh flat = generate::plane({.columns = 2, .rows = 2});
  const auto height = [&](Forces forces) {
    FitOptions options{.criterion = Weight{0.5}};
    options.fair.method = SweepMethod{.max_iterations = 1};
    options.fair.forces = forces;
    options.fair.as_found = true;
    const FitResult result = fit(flat, held_boundary(flat), {.positions = {Vector3(0.5, 0.5, 0.1)}}, options);
    return result.positions[4].z();
  };
  EXPECT_NEAR(height(Forces::printed), 0.5 * 0.1, 1e-12);
  EXPECT_NEAR(height(Forces::steady), 0.5 * 0.1 / 1.5, 1e-12);
}

TEST(PrintedForces, LeaveNodesInLineWithTheirNeighboursWhereTheyAre) {
  const PolygonCurve bent(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {4, 1, 0}});
  const auto moved = [&](Forces forces) {
    Net net = gather_net(bent, held_ends(bent.positions()));
    ThreadTeam team(1);
    const auto model = curve_model_for(net, CurveRules::paper(), forces);
    update_directions(net, *model, team);
    std::vector<NodeForce> force(net.moving);
    model->find_forces(net, {0, net.moving}, force);
    std::vector<double> springs(5, 0);
    for (std::size_t i = 0; i < net.moving; ++i)
      springs[static_cast<std::size_t>(net.node[i])] = force[i].spring.norm() / net.frame.scale();
    return springs;
  };
  EXPECT_EQ(moved(Forces::printed)[1], 0);
  EXPECT_GT(moved(Forces::steady)[1], 0.01);
  // Node 2 between node 1, which has no normal, and node 3, which faces the other way. Eq. 4 with N = 0 is the part of
  // the edge along the own normal.
  const Vector3 tangent = Vector3(2, 1, 0).normalized();
  const Vector3 own(-tangent.y(), tangent.x(), 0);
  const Vector3 next = Vector3(2, 1, 0).normalized();
  const Vector3 other(-next.y(), next.x(), 0);
  const Vector3 back(-1, 0, 0);
  const Vector3 ahead(1, 1, 0);
  const double first = back.dot(own);
  const double second = ahead.dot(own + other) / (1 + own.dot(other));
  const double weight = 1 / ahead.norm();
  EXPECT_NEAR(moved(Forces::printed)[2], std::abs(first + weight * second) / (1 + weight), 1e-12);
}

}  // namespace
}  // namespace vspring::printed_forces_test
