#include "fit/interior_fit.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "support/curves.hpp"

namespace vspring::interior_fit_test {
namespace {

using namespace support;

Net net_of_curve(const std::vector<Vector3>& nodes, const Constraints& constraints) {
  Net net = gather_net(PolygonCurve(nodes), constraints);
  curve_model_for(net, {})->update_directions(net, 0, net.computed);
  return net;
}

/// A roof, up and down again; its ridge is node 2.
const std::vector<Vector3> roof = {{-2, -2, 0}, {-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {2, -2, 0}};

std::size_t local(const Net& net, Index node) {
  std::size_t i = 0;
  while (net.node[i] != node) ++i;
  return i;
}

TEST(Sides, FlipAcrossEdgesAndNotAcrossTheNodesTangent) {
  const Net net = net_of_curve(roof, held_ends(roof));
  const auto sides = Sides::of(net);
  ASSERT_TRUE(sides.has_value());
  const std::size_t ridge = local(net, 2);
  const auto side = [&](const Vector3& point) { return sides->side(net, ridge, net.frame.to_local(point)); };
  // Beside the middle of either edge, where the level through the ridge is above both.
  for (const double x : {-0.5, 0.5}) {
    EXPECT_LT(side({x, -0.4, 0}), 0);
    EXPECT_GT(side({x, -0.6, 0}), 0);
    EXPECT_GT(sides->across(net, ridge).dot(net.positions[ridge] - net.frame.to_local({x, -0.4, 0})), 0)
        << "or it would show nothing";
  }
  EXPECT_LT(side({0, 0.3, 0}), 0);
  EXPECT_GT(side({0, -0.3, 0}), 0);
  EXPECT_NEAR((sides->across(net, ridge) - Vector3(0, 1, 0)).norm(), 0, 1e-12);
}

TEST(Sides, AreThoseOfTheWayOfTheCurve) {
  // Gone along the other way, left is right.
  const std::vector<Vector3> back(roof.rbegin(), roof.rend());
  const Net net = net_of_curve(back, held_ends(back));
  const auto sides = Sides::of(net);
  ASSERT_TRUE(sides.has_value());
  const std::size_t ridge = local(net, 2);
  EXPECT_GT(sides->side(net, ridge, net.frame.to_local({0.5, -0.4, 0})), 0);
  EXPECT_LT(sides->side(net, ridge, net.frame.to_local({0.5, -0.6, 0})), 0);
}

TEST(Sides, ThereAreNoneInSpace) {
  std::vector<Vector3> nodes = roof;
  nodes[1].z() = 0.5;
  EXPECT_FALSE(Sides::of(net_of_curve(nodes, held_ends(nodes))).has_value());
  // Nor where a point lies out of the curve's plane.
  Net net = net_of_curve(roof, held_ends(roof));
  EXPECT_TRUE(Sides::of(net).has_value());
  net.points.positions.emplace_back(0, 0, 0.5);
  EXPECT_FALSE(Sides::of(net).has_value());
}

}  // namespace
}  // namespace vspring::interior_fit_test
