#include "equilibrium/elastica.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "levels/curve_levels.hpp"
#include "spring/curve_net.hpp"
#include "support/curves.hpp"

namespace vspring::elastica_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

Net net_of(const PolygonCurve& curve, const Constraints& constraints) {
  return curve_levels(gather_net(curve, constraints), Distribution::even).back().net;
}

EquilibriumResult relaxed(Net& net, double tolerance = 1e-9) {
  Context context;
  EquilibriumTask task;
  task.tolerance = tolerance;
  return relax_to_elastica(net, task, context);
}

double length_of(const Net& net) {
  double sum = 0;
  for (const MovingRun& run : net.moving_runs) {
    const std::size_t count = run.nodes.size();
    for (std::size_t k = 0; k + (run.closed ? 0 : 1) < count; ++k)
      sum += (net.positions[run.nodes[(k + 1) % count]] - net.positions[run.nodes[k]]).norm();
  }
  return sum;
}

/// How far the elastica between the tangents of an arc is from it.
double error_of_arc(int edges) {
  std::vector<Vector3> nodes;
  for (const double at : places(Spacing::even, edges)) nodes.emplace_back(heading(1.5 * pi * at));
  Net net = net_of(PolygonCurve(nodes), held_ends(nodes, heading(pi / 2), heading(2 * pi)));
  const std::vector<Vector3> before = net.positions;
  EXPECT_EQ(relaxed(net, 1e-12).outcome, Outcome::converged);
  double greatest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) greatest = std::max(greatest, (net.positions[i] - before[i]).norm());
  return greatest;
}

TEST(Elastica, AnArcBetweenItsTangentsIsOneToSecondOrder) {
  const double coarse = error_of_arc(60);
  EXPECT_LT(coarse, 1e-5);
  EXPECT_GT(coarse / error_of_arc(120), 3.8);
}

TEST(Elastica, KeepsLengthAndPlaneAndBendsLess) {
  // A tilted plane, noise in it.
  const Vector3 across = Vector3(1, 2, 3).normalized();
  const Vector3 first = across.unitOrthogonal();
  const Vector3 second = across.cross(first);
  std::vector<Vector3> nodes;
  Draw draw(3);
  for (const double at : places(Spacing::graded, 80)) {
    const double noise = at > 0 && at < 1 ? draw.uniform(-0.003, 0.003) : 0;
    nodes.emplace_back(at * first + (0.2 * std::sin(2 * pi * at) + noise) * second);
  }
  Net net = net_of(PolygonCurve(nodes), held_ends(nodes, first + 1.2 * second, first + 1.2 * second));
  const double length = length_of(net);
  EXPECT_EQ(relaxed(net).outcome, Outcome::converged);
  EXPECT_NEAR(length_of(net), length, 1e-9 * length);
  double least = net.positions[0].dot(across);
  for (const Vector3& position : net.positions) EXPECT_NEAR(position.dot(across), least, 1e-12);
}

TEST(Elastica, AClosedCurveBecomesACircleAboutItsCentre) {
  std::vector<Vector3> nodes;
  for (int k = 0; k < 48; ++k) {
    const double angle = 2 * pi * k / 48;
    nodes.emplace_back(3 * std::cos(angle), std::sin(angle), 0.2 * std::sin(2 * angle));
  }
  const PolygonCurve ellipse(nodes, true);
  Net net = net_of(ellipse, Constraints(48));
  const double length = length_of(net);
  EXPECT_EQ(relaxed(net, 1e-7).outcome, Outcome::converged);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& position : net.positions) centre += position / 48;
  const double radius = length / (2 * 48 * std::sin(pi / 48));
  for (const Vector3& position : net.positions) EXPECT_NEAR((position - centre).norm(), radius, 1e-5 * radius);
}

TEST(Elastica, AFreeEndIsStraight) {
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 40; ++k) nodes.emplace_back(0.1 * k, 0.3 * std::sin(0.3 * k), 0);
  Constraints constraints(41);
  constraints.fix_position(0, nodes.front());
  constraints.fix_tangent(0, Vector3(1, 1, 0));
  Net net = net_of(PolygonCurve(nodes), constraints);
  EXPECT_EQ(relaxed(net).outcome, Outcome::converged);
  // Nothing bends it: it leaves along the tangent.
  const auto& run = net.moving_runs[0].nodes;
  const Vector3 start = net.positions[run.front()];
  for (const std::size_t i : run)
    EXPECT_LT((net.positions[i] - start).cross(Vector3(1, 1, 0).normalized()).norm(), 1e-8);
}

TEST(Elastica, StraightAndSingleEdgesBetweenHeldNodesStay) {
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 20; ++k) nodes.emplace_back(k, k < 10 ? 0 : 0.1 * (k - 10) * (k - 10), 0);
  Constraints constraints(21);
  for (const Index i : {0, 1, 9, 20}) constraints.fix_position(i, nodes[static_cast<std::size_t>(i)]);
  Net net = net_of(PolygonCurve(nodes), constraints);
  const EquilibriumResult result = relaxed(net);
  EXPECT_EQ(result.outcome, Outcome::converged);
  const std::vector<Vector3> places = scatter_positions(net, nodes, constraints, 1);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_LT((places[i] - nodes[i]).norm(), 1e-9);
}

TEST(Elastica, PiecesThatCannotReachAreLeftAlone) {
  // All nodes in one place but the last: no lengths.
  const std::vector<Vector3> nodes(12, Vector3::Zero());
  Net net = net_of(PolygonCurve(nodes), held_ends(nodes, Vector3::UnitX(), Vector3::UnitX()));
  const EquilibriumResult result = relaxed(net);
  EXPECT_NE(result.outcome, Outcome::converged);
  for (const Vector3& position : net.positions) EXPECT_TRUE(position.allFinite());
}

TEST(Elastica, EndsWhereItIsCancelled) {
  std::vector<Vector3> nodes;
  for (const double at : places(Spacing::even, 60)) nodes.emplace_back(at, 0.3 * std::sin(9 * at), 0);
  Net net = net_of(PolygonCurve(nodes), held_ends(nodes));
  const std::vector<Vector3> before = net.positions;
  Context context;
  context.cancel();
  EXPECT_EQ(relax_to_elastica(net, {}, context).outcome, Outcome::cancelled);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(net.positions[i], before[i]);
}

}  // namespace
}  // namespace vspring::elastica_test
