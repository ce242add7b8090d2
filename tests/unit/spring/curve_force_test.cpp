#include "spring/curve_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "spring/tangent.hpp"

namespace vspring::curve_force_test {
namespace {

std::vector<Link> inner_links(std::uint32_t i) {
  return {{(i - 1) | Link::spoke_bit | Link::start_bit}, {(i + 1) | Link::spoke_bit}};
}

// A point of the circle of radius 3 about (1, 2, 0) in a tilted plane.
Vector3 on_circle(double angle) {
  const Vector3 a = Vector3(1, 2, 2) / 3;
  const Vector3 b = Vector3(2, 1, -2) / 3;
  return Vector3(1, 2, 0) + 3 * (std::cos(angle) * a + std::sin(angle) * b);
}

Vector3 circle_tangent(double angle) {
  const Vector3 a = Vector3(1, 2, 2) / 3;
  const Vector3 b = Vector3(2, 1, -2) / 3;
  return -std::sin(angle) * a + std::cos(angle) * b;
}

Net net_of(const std::vector<Vector3>& nodes) {
  const PolygonCurve curve(nodes);
  Constraints constraints(curve.node_count());
  fix_boundary_positions(constraints, curve);
  Net net = gather_net(curve, constraints);
  ThreadTeam alone(1);
  const auto model = curve_model({});
  model->prepare(net);
  update_directions(net, *model, alone);
  return net;
}

/// V-Spring displacements of the inner nodes, in the units of the curve.
std::vector<Vector3> springs(const Net& net) {
  std::vector<Vector3> all;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto spring = [&](std::size_t j) { return curve_spring(net, i, j); };
    all.emplace_back(curve_force<InverseCubeWeight>(net, i, spring).spring / net.frame.scale());
  }
  return all;
}

const std::vector<double> uneven = {0.1, 0.13, 0.5, 0.52, 1.7, 1.9, 2.6};

TEST(Tangent, OfTheCircleIsExactForUnevenNodes) {
  std::vector<Vector3> nodes;
  nodes.reserve(uneven.size());
  for (const double angle : uneven) nodes.push_back(on_circle(angle));
  for (std::uint32_t i = 1; i + 1 < nodes.size(); ++i) {
    const auto links = inner_links(i);
    EXPECT_LT((CircleTangent()(nodes[i], links, nodes) - circle_tangent(uneven[i])).norm(), 1e-13);
    const Vector3 normal = principal_normal(nodes[i], links, nodes, circle_tangent(uneven[i]));
    EXPECT_LT((normal - (Vector3(1, 2, 0) - nodes[i]) / 3).norm(), 1e-12);
  }
}

TEST(Tangent, OfThePaperIsTheChordOfTheNeighboursHoweverUneven) {
  const std::vector<Vector3> nodes = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}};
  EXPECT_LT((ChordTangent()(nodes[1], inner_links(1), nodes) - Vector3(1, 3, 0).normalized()).norm(), 1e-15);
}

TEST(Tangent, OfAnEndIsItsChord) {
  const std::vector<Vector3> nodes = {{0, 0, 0}, {2, 0, 0}};
  const std::vector<Link> first = {{1 | Link::spoke_bit}};
  const std::vector<Link> last = {{0 | Link::spoke_bit | Link::start_bit}};
  EXPECT_EQ(CircleTangent()(nodes[0], first, nodes), Vector3(1, 0, 0));
  EXPECT_EQ(CircleTangent()(nodes[1], last, nodes), Vector3(1, 0, 0));
}

TEST(CurveForce, IsNoneOnACircleHoweverUnevenTheNodes) {
  std::vector<Vector3> nodes;
  nodes.reserve(uneven.size());
  for (const double angle : uneven) nodes.push_back(on_circle(angle));
  const auto all = springs(net_of(nodes));
  // The first and the last feel the ends, which are free to turn.
  for (std::size_t i = 1; i + 1 < all.size(); ++i) EXPECT_LT(all[i].norm(), 1e-14);
  EXPECT_GT(all.front().norm(), 1e-4);
}

TEST(CurveForce, CurvatureIsThatOfTheCircleToRounding) {
  // Far from the origin of the circle's angle, so that nothing cancels by luck.
  for (const double step : {1e-1, 1e-3, 1e-5}) {
    const Net net = net_of({on_circle(1), on_circle(1 + step), on_circle(1 + 2.5 * step)});
    const double curvature = net.curvatures[0].norm() * net.frame.scale();
    // Positions are known to 1e-16, and the curvature follows from their second differences.
    EXPECT_NEAR(3 * curvature, 1, 20 * 1e-16 / (step * step) + 1e-15);
    EXPECT_LT(std::abs(net.curvatures[0].dot(net.tangents[0])), 1e-15 * net.curvatures[0].norm() / step + 1e-15);
  }
}

TEST(CurveForce, OnAPlanarCurveIsEquationFiveWithTheInPlaneNormal) {
  const Vector3 tangent_i(std::cos(0.3), std::sin(0.3), 0);
  const Vector3 tangent_j(std::cos(1.2), std::sin(1.2), 0);
  const Vector3 normal_i(-std::sin(0.3), std::cos(0.3), 0);
  const Vector3 normal_j(-std::sin(1.2), std::cos(1.2), 0);
  const Vector3 d(0.8, 0.9, 0);
  const Vector3 expected = spring_difference(d, normal_i, normal_j) * normal_i;
  const Vector3 bend_i = d.dot(normal_i) * normal_i;
  const Vector3 bend_j = -d.dot(normal_j) * normal_j;
  EXPECT_LT((curve_spring(bend_i, bend_j, d, tangent_i, tangent_j) - expected).norm(), 1e-15);
}

TEST(CurveForce, AlongThePrincipalNormalIsAllOfItInAPlane) {
  // Beside ends and straight runs too, which have no principal normal; a node of the run has no force then.
  const std::vector<Vector3> nodes = {{0, 0, 0}, {1, 0.2, 0},   {2, 0, 0},     {3, 0, 0},
                                      {4, 0, 0}, {4.9, 0.4, 0}, {5.4, 1.3, 0}, {6, 1.5, 0}};
  const auto forces = [&](NormalPlane plane) {
    Net net = net_of(nodes);
    ThreadTeam alone(1);
    const auto model = curve_model({.normal_plane = plane});
    update_directions(net, *model, alone);
    std::vector<NodeForce> all(net.moving);
    model->find_forces(net, {0, net.moving}, all);
    return all;
  };
  const auto full = forces(NormalPlane::full);
  const auto principal = forces(NormalPlane::principal);
  ASSERT_EQ(full.size(), 6U);
  for (std::size_t i = 0; i < full.size(); ++i) {
    const bool straight = i == 2;
    EXPECT_GT(full[i].spring.norm(), 1e-3) << i;
    EXPECT_LT((principal[i].spring - (straight ? Vector3(0, 0, 0) : full[i].spring)).norm(), 1e-15) << i;
  }
}

TEST(CurveForce, FramesAreCarriedWithoutSpin) {
  const Vector3 from = Vector3(1, 2, 3).normalized();
  const Vector3 to = Vector3(2, 2, 2.5).normalized();
  const Vector3 d(0.3, 0.5, 0.5);
  EXPECT_LT((carried(from, d, from, to) - to).norm(), 1e-15);
  const Vector3 normal = from.cross(Vector3(0, 0, 1));
  EXPECT_LT((carried(carried(normal, d, from, to), -d, to, from) - normal).norm(), 1e-15);
  EXPECT_NEAR(carried(normal, d, from, to).norm(), normal.norm(), 1e-15);
  // In a plane the carried normal is the turned one.
  const Vector3 flat = carried({0, 1, 0}, {1, 0.2, 0}, {1, 0, 0}, {std::cos(0.5), std::sin(0.5), 0});
  EXPECT_LT((flat - Vector3(-std::sin(0.5), std::cos(0.5), 0)).norm(), 1e-15);
  EXPECT_LT((carried({0, 0, 1}, {1, 0.2, 0}, {1, 0, 0}, {std::cos(0.5), std::sin(0.5), 0}) - Vector3(0, 0, 1)).norm(),
            1e-15);
}

TEST(CurveForce, OnAHelixHasTheSizeThatItsTorsionPredicts) {
  // Curvature and torsion of (a cos s/c, a sin s/c, b s/c), c² = a² + b², are a/c² and b/c²; the displacement is
  // ℓ⁴κτ²/8 in the limit.
  const double a = 1;
  const double b = 0.7;
  const double c = std::sqrt(a * a + b * b);
  double before = 0;
  for (const double spacing : {0.1, 0.05}) {
    std::vector<Vector3> nodes;
    for (int k = -3; k <= 3; ++k) {
      const double s = k * spacing;
      nodes.emplace_back(a * std::cos(s / c), a * std::sin(s / c), b * s / c);
    }
    const double force = springs(net_of(nodes))[2].norm();
    const double predicted = std::pow(spacing, 4) * (a / (c * c)) * std::pow(b / (c * c), 2) / 8;
    const double error = std::abs(force / predicted - 1);
    EXPECT_LT(error, 0.02);
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.5);
    }
    before = error;
  }
}

TEST(CurveForce, IsFiniteWhereTangentsAreOppositeOrMissing) {
  EXPECT_EQ(curve_spring(Vector3::Zero(), Vector3::Zero(), {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}), Vector3::Zero());
  for (const Vector3& force : springs(net_of(std::vector<Vector3>(5, Vector3(1, 2, 3)))))
    EXPECT_TRUE(force.allFinite());
}

}  // namespace
}  // namespace vspring::curve_force_test
