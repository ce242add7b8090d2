#include "checks/curve_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spring/curve_net.hpp"
#include "support/curves.hpp"

namespace vspring::curve_crossings_test {
namespace {

using namespace support;

std::size_t crossings_of(const std::vector<Vector3>& nodes, bool closed = false) {
  ThreadTeam team(2);
  Constraints constraints(static_cast<Index>(nodes.size()));
  hold(constraints, nodes, 0);
  if (!closed) hold(constraints, nodes, constraints.node_count() - 1);
  const Net net = gather_net(PolygonCurve(nodes, closed), constraints);
  return curve_crossings(net, net.positions, team);
}

/// Looks at all pairs.
std::size_t counted(const std::vector<Vector3>& nodes) {
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (nodes[b] - nodes[a]).cross(nodes[c] - nodes[a]).z();
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < nodes.size(); ++j) {
      if (side(i, i + 1, j) * side(i, i + 1, j + 1) < 0 && side(j, j + 1, i) * side(j, j + 1, i + 1) < 0) ++count;
    }
  }
  return count;
}

TEST(CurveCrossings, OfKnownCurves) {
  std::vector<Vector3> eight;
  std::vector<Vector3> trefoil;
  std::vector<Vector3> in_space;
  std::vector<Vector3> spiral;
  for (int k = 0; k < 200; ++k) {
    const double t = 2 * std::numbers::pi * (k + 0.3) / 200;
    eight.emplace_back(std::sin(t), std::sin(2 * t), 0);
    trefoil.emplace_back(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), 0);
    in_space.emplace_back(trefoil.back() + Vector3(0, 0, std::sin(3 * t)));
    spiral.emplace_back((1 + t) * heading(3 * t));
  }
  EXPECT_EQ(crossings_of(eight, true), 1U);
  EXPECT_EQ(crossings_of(trefoil, true), 3U);
  EXPECT_EQ(crossings_of(in_space, true), 0U) << "only as it is seen from above";
  EXPECT_EQ(crossings_of(spiral), 0U);
  EXPECT_EQ(crossings_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), 0U);
}

TEST(CurveCrossings, OfATailThatIsAsGoodAsClosedDoNotCount) {
  // From a tail over a round nose and back, the sides of the tail on the wrong side of each other up to `wrong`.
  for (const double wrong : {0.02, 0.2}) {
    std::vector<Vector3> nodes;
    for (int k = -50; k <= 50; ++k) {
      const double at = k / 50.0;
      nodes.emplace_back(at * at, at * (1 - at * at - wrong), 0);
    }
    EXPECT_EQ(crossings_of(nodes), wrong < 0.1 ? 0U : 1U) << wrong;
  }
}

TEST(CurveCrossings, AreThoseThatAllPairsGive) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Draw draw(seed);
    std::vector<Vector3> nodes = {Vector3::Zero()};
    for (int k = 0; k < 300; ++k) {
      Vector3 step = draw.in_cube(1);
      step.z() = 0;
      nodes.emplace_back(nodes.back() + step);
    }
    EXPECT_GT(counted(nodes), 20U);
    EXPECT_EQ(crossings_of(nodes), counted(nodes));
  }
}

}  // namespace
}  // namespace vspring::curve_crossings_test
