// Forces as the paper prints them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
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
    options.fair.accept_worse = true;
    const FitResult result = fit(flat, held_boundary(flat), {.positions = {Vector3(0.5, 0.5, 0.1)}}, options);
    return result.positions[4].z();
  };
  EXPECT_NEAR(height(Forces::printed), 0.5 * 0.1, 1e-12);
  EXPECT_NEAR(height(Forces::steady), 0.5 * 0.1 / 1.5, 1e-12);
}

/// How far springs push each node, in the paper's own choices for curves.
std::vector<double> pushed(const PolygonCurve& curve, Forces forces) {
  Net net = gather_net(curve, held_ends(curve.positions()));
  ThreadTeam team(1);
  const auto model = curve_model_for(net, CurveRules::paper(), forces);
  update_directions(net, *model, team);
  std::vector<NodeForce> force(net.moving);
  model->find_forces(net, {0, net.moving}, force);
  std::vector<double> springs(curve.positions().size(), 0);
  for (std::size_t i = 0; i < net.moving; ++i)
    springs[static_cast<std::size_t>(net.node[i])] = force[i].spring.norm() / net.frame.scale();
  return springs;
}

/// The first node after a straight run, between node 1, whose normal is given here, and node 3.
double between(const Vector3& own, const Vector3& first_normal, const Vector3& next_normal) {
  const Vector3 back(-1, 0, 0);
  const Vector3 ahead(1, 1, 0);
  const auto difference = [&](const Vector3& d, const Vector3& other) {
    const Vector3 turned = other.dot(own) < 0 ? Vector3(-other) : other;
    return d.dot(own + turned) / (1 + own.dot(turned));
  };
  const double weight = 1 / ahead.norm();
  return std::abs(difference(back, first_normal) + weight * difference(ahead, next_normal)) / (1 + weight);
}

TEST(PrintedForces, LeaveNodesOfSpaceCurvesInLineWithTheirNeighboursWhereTheyAre) {
  const PolygonCurve bent(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {4, 1, 1}});
  EXPECT_EQ(pushed(bent, Forces::printed)[1], 0);
  // Eq. 4 with N = 0 at node 1 is the part of the edge along the own normal.
  const Vector3 own = Vector3(-1, 2, 0).normalized();
  const Vector3 next = Vector3(1, 1, 0).cross(Vector3(1, 0, 1)).cross(Vector3(2, 1, 1)).normalized();
  EXPECT_NEAR(pushed(bent, Forces::printed)[2], between(own, Vector3::Zero(), next), 1e-12);
  EXPECT_GT(std::abs(pushed(bent, Forces::steady)[2] - pushed(bent, Forces::printed)[2]), 1e-3);
}

TEST(PrintedForces, GiveNodesOfPlaneCurvesTheMeanNormalOfTheirEdges) {
  const PolygonCurve bent(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {4, 1, 0}});
  const Vector3 flat(0, 1, 0);
  const Vector3 steep = Vector3(-1, 1, 0).normalized();
  const Vector3 own = (flat + steep).normalized();
  EXPECT_NEAR(pushed(bent, Forces::printed)[2], between(own, flat, own), 1e-12);
  // Node 1 has nodes with the normals (0, 1) and (−sin 22.5°, cos 22.5°) at a distance of 1.
  const Vector3 difference = own + flat;
  EXPECT_NEAR(pushed(bent, Forces::printed)[1], std::abs(difference.x() / (1 + own.dot(flat))) / 2, 1e-12);
}

}  // namespace
}  // namespace vspring::printed_forces_test
