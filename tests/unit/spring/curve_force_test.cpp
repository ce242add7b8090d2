#include "spring/curve_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spring/tangent.hpp"

namespace vspring {
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

Vector3 spring_at(std::uint32_t i, const std::vector<Vector3>& nodes, const std::vector<Vector3>& tangents) {
  const auto spring = [&](std::size_t j, const Vector3& d) { return curve_spring(d, tangents[i], tangents[j]); };
  return curve_force<InverseCubeWeight>(i, inner_links(i), nodes, tangents[i], {}, 1e-30, spring).spring;
}

const std::vector<double> uneven = {0.1, 0.13, 0.5, 0.52, 1.7, 1.9, 2.6};

TEST(Tangent, OfTheCircleIsExactForUnevenNodes) {
  std::vector<Vector3> nodes;
  for (const double angle : uneven) nodes.push_back(on_circle(angle));
  for (std::uint32_t i = 1; i + 1 < nodes.size(); ++i) {
    const auto links = inner_links(i);
    EXPECT_LT((CircleTangent()(nodes[i], links, nodes) - circle_tangent(uneven[i])).norm(), 1e-13);
    const Vector3 normal = principal_normal(nodes[i], links, nodes, circle_tangent(uneven[i]));
    EXPECT_LT((normal - (Vector3(1, 2, 0) - nodes[i]) / 3).norm(), 1e-12);
  }
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
  std::vector<Vector3> tangents;
  for (const double angle : uneven) {
    nodes.push_back(on_circle(angle));
    tangents.push_back(circle_tangent(angle));
  }
  for (std::uint32_t i = 1; i + 1 < nodes.size(); ++i) EXPECT_LT(spring_at(i, nodes, tangents).norm(), 1e-13);
}

TEST(CurveForce, OnAPlanarCurveIsEquationFiveWithTheInPlaneNormal) {
  const Vector3 tangent_i(std::cos(0.3), std::sin(0.3), 0);
  const Vector3 tangent_j(std::cos(1.2), std::sin(1.2), 0);
  const Vector3 normal_i(-std::sin(0.3), std::cos(0.3), 0);
  const Vector3 normal_j(-std::sin(1.2), std::cos(1.2), 0);
  const Vector3 d(0.8, 0.9, 0);
  const Vector3 expected = spring_difference(d, normal_i, normal_j) * normal_i;
  EXPECT_LT((curve_spring(d, tangent_i, tangent_j) - expected).norm(), 1e-15);
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
    for (int k = -2; k <= 2; ++k) {
      const double s = k * spacing;
      nodes.emplace_back(a * std::cos(s / c), a * std::sin(s / c), b * s / c);
    }
    std::vector<Vector3> tangents(nodes.size(), Vector3::Zero());
    for (std::uint32_t i = 1; i < 4; ++i) tangents[i] = CircleTangent()(nodes[i], inner_links(i), nodes);
    const double force = spring_at(2, nodes, tangents).norm();
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
  EXPECT_EQ(curve_spring({1, 0, 0}, {1, 0, 0}, {-1, 0, 0}), Vector3::Zero());
  const std::vector<Vector3> nodes = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const std::vector<Vector3> tangents(3, Vector3::Zero());
  EXPECT_TRUE(spring_at(1, nodes, tangents).allFinite());
  EXPECT_EQ(CircleTangent()(nodes[1], inner_links(1), nodes), Vector3::Zero());
}

}  // namespace
}  // namespace vspring
