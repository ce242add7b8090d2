#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "levels/levels.hpp"
#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "support/curves.hpp"

namespace vspring::curve_levels_test {
namespace {

using namespace support;

std::vector<Vector3> arc(const std::vector<double>& at, double turn) {
  std::vector<Vector3> nodes;
  nodes.reserve(at.size());
  for (const double place : at) nodes.push_back(heading(place * turn));
  return nodes;
}

std::vector<Level> levels_of(const std::vector<Vector3>& nodes, const Constraints& constraints, bool closed,
                             Distribution distribution) {
  return curve_levels(gather_net(PolygonCurve(nodes, closed), constraints), distribution);
}

/// The numbers in the curve of the nodes of a level's only run.
std::vector<Index> numbers(const Level& level) {
  std::vector<Index> all;
  for (const std::uint32_t i : level.net.moving_runs[0].nodes) all.push_back(level.net.node[i]);
  return all;
}

TEST(CurveLevels, HalveSpansAsLongAsEnoughNodesAreLeft) {
  const auto nodes = arc(places(Spacing::even, 1000), 2);
  const auto levels = levels_of(nodes, held_ends(nodes), false, Distribution::even);
  ASSERT_EQ(levels.size(), 6U);
  const std::vector<std::size_t> edges = {32, 63, 125, 250, 500, 1000};
  for (std::size_t k = 0; k < levels.size(); ++k) {
    EXPECT_EQ(levels[k].net.moving_runs[0].nodes.size(), edges[k] + 1);
    EXPECT_EQ(levels[k].net.moving, edges[k] - 1);
    EXPECT_EQ(numbers(levels[k]).front(), 0);
    EXPECT_EQ(numbers(levels[k]).back(), 1000);
    const auto ascending = numbers(levels[k]);
    EXPECT_TRUE(std::is_sorted(ascending.begin(), ascending.end()));
  }
  EXPECT_TRUE(levels.back().finer.empty());
  const auto few = arc(places(Spacing::even, 47), 2);
  EXPECT_EQ(levels_of(few, held_ends(few), false, Distribution::even).size(), 1U);
}

TEST(CurveLevels, KeepNodesThatAreHeldOrHaveADirection) {
  for (const bool closed : {false, true}) {
    const auto nodes = arc(places(Spacing::even, 600), closed ? 6.2 : 3);
    Constraints constraints = held_ends(nodes);
    for (const Index i : {101, 102, 333}) hold(constraints, nodes, i);
    constraints.fix_tangent(205, {1, 0, 0});
    constraints.fix_normal(477, {0, 1, 0});
    const auto levels = levels_of(nodes, constraints, closed, Distribution::even);
    ASSERT_GT(levels.size(), 2U);
    for (const Level& level : levels) {
      const auto all = numbers(level);
      for (const Index i : {0, 101, 102, 205, 333, 477, 600}) EXPECT_EQ(std::count(all.begin(), all.end(), i), 1) << i;
      for (std::size_t i = 0; i < level.net.node.size(); ++i) {
        EXPECT_EQ(level.net.tangent_given(i), level.net.node[i] == 205);
        EXPECT_EQ(level.net.normal_given(i), level.net.node[i] == 477);
        EXPECT_EQ(i < level.net.moving, !constraints.position_fixed(level.net.node[i]));
      }
    }
  }
}

TEST(CurveLevels, SharesMakeLengthsGoByThePlacesAlong) {
  // On every level of an arc with kept spacing, all nodes are where their shares want them already, to second order.
  const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::random, 400, 5));
  const auto levels = levels_of(nodes, held_ends(nodes), false, Distribution::keep);
  ASSERT_GT(levels.size(), 3U);
  for (const Level& level : levels) {
    const auto& moving_run = level.net.moving_runs[0].nodes;
    const auto& at = level.net.moving_runs[0].along;
    const Net& net = level.net;
    for (std::size_t k = 1; k + 1 < moving_run.size(); ++k) {
      const auto shares = net.weights_of(moving_run[k]);
      ASSERT_EQ(shares.size(), 2U);
      EXPECT_NEAR(shares[0] + shares[1], 1, 1e-15);
      EXPECT_NEAR(shares[0] * (at[k] - at[k - 1]), shares[1] * (at[k + 1] - at[k]), 1e-12);
      const Index number = net.node[moving_run[k]];
      EXPECT_NEAR(at[k] / at.back(), nodes[static_cast<std::size_t>(number)].x(), 1e-12);
    }
  }
  EXPECT_TRUE(levels_of(nodes, held_ends(nodes), false, Distribution::even).back().net.laplacian_weights.empty());
}

TEST(CurveLevels, ProlongationOnACircleIsExactInTheMiddleAndOfSixthOrderElsewhere) {
  for (const bool closed : {false, true}) {
    for (const Spacing spacing : {Spacing::even, Spacing::random}) {
      std::vector<double> error;
      for (const int edges : {60, 120, 240}) {
        auto nodes = arc(places(spacing, edges, 2), closed ? 360 * degree : 3);
        if (closed) nodes.pop_back();
        Constraints constraints(static_cast<Index>(nodes.size()));
        hold(constraints, nodes, 0);
        hold(constraints, nodes, constraints.node_count() - 1);
        auto levels = levels_of(nodes, constraints, closed, Distribution::keep);
        ASSERT_GT(levels.size(), 1U);
        Level& fine = levels.back();
        Level& coarse = levels[levels.size() - 2];
        // Coarse nodes were averaged: back to the circle.
        for (std::size_t i = 0; i < coarse.net.moving; ++i)
          coarse.net.positions[i] = fine.net.frame.to_local(nodes[static_cast<std::size_t>(coarse.net.node[i])]);
        // End tangents that the circle has, as the curve alone does not know them.
        for (std::size_t i = 0; i < coarse.net.node.size(); ++i) {
          const Vector3& p = nodes[static_cast<std::size_t>(coarse.net.node[i])];
          coarse.net.tangents[i] = Vector3(-p.y(), p.x(), 0);
        }
        prolong_curve(coarse, fine);
        const auto result = scatter_positions(fine.net, nodes, constraints, 1);
        double greatest = 0;
        for (const Vector3& p : result) greatest = std::max(greatest, std::abs(p.norm() - 1));
        error.push_back(greatest);
      }
      SCOPED_TRACE(::testing::Message() << error[0] << " " << error[1] << " " << error[2]);
      EXPECT_LT(error[2], 1e-11);
      if (spacing == Spacing::even) {
        EXPECT_LT(error[0], 1e-15);
      } else {
        EXPECT_GT(order(error[0], error[2]), 2 * 5.5);
      }
    }
  }
}

double sharpest_cosine(const Net& net) {
  double smallest = 1;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    const Vector3 before = net.positions[i] - net.positions[links[0].node()];
    const Vector3 after = net.positions[links[1].node()] - net.positions[i];
    smallest = std::min(smallest, before.normalized().dot(after.normalized()));
  }
  return smallest;
}

TEST(Untangle, LeavesSmoothShapesAlone) {
  const auto nodes = arc(places(Spacing::random, 40), 4.5);
  auto levels = levels_of(nodes, held_ends(nodes), false, Distribution::keep);
  const auto before = levels[0].net.positions;
  untangle(levels[0].net);
  EXPECT_EQ(levels[0].net.positions, before);
}

TEST(Untangle, AveragesNoiseUntilNoTurnIsSharp) {
  const auto smooth = arc(places(Spacing::even, 40), 3);
  const Constraints constraints = held_ends(smooth);
  const auto nodes = noisy(smooth, constraints, 0.1, 3, false);
  auto levels = levels_of(nodes, constraints, false, Distribution::even);
  EXPECT_LT(sharpest_cosine(levels[0].net), 0);
  untangle(levels[0].net);
  EXPECT_GE(sharpest_cosine(levels[0].net), 0.5);
  const auto result = scatter_positions(levels[0].net, nodes, constraints, 1);
  EXPECT_LT(greatest_distance(result, smooth), 0.2);
  EXPECT_EQ(result.front(), nodes.front());
}

TEST(Straighten, PutsNodesOnTheLinesBetweenHeldOnes) {
  const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 40));
  Constraints constraints = held_ends(nodes);
  constraints.fix_position(15, {0.4, 0.5, 0.1});
  auto levels = levels_of(nodes, constraints, false, Distribution::even);
  start_from_chords(levels[0].net);
  const auto result = scatter_positions(levels[0].net, nodes, constraints, 1);
  const auto first = straight({0, 0, 0}, {0.4, 0.5, 0.1}, places(Spacing::even, 15));
  const auto second = straight({0.4, 0.5, 0.1}, {1, 0, 0}, places(Spacing::even, 25));
  for (std::size_t i = 0; i <= 40; ++i)
    EXPECT_LT((result[i] - (i < 15 ? first[i] : second[i - 15])).norm(), 1e-14) << i;
}

TEST(Straighten, LeavesALoopFromOneNodeToItself) {
  std::vector<Vector3> nodes = arc(places(Spacing::graded, 40, 30), 360 * degree);
  nodes.pop_back();
  Constraints constraints(40);
  hold(constraints, nodes, 0);
  auto levels = levels_of(nodes, constraints, true, Distribution::even);
  const auto before = levels[0].net.positions;
  start_from_chords(levels[0].net);
  EXPECT_EQ(levels[0].net.positions, before);
}

TEST(Straighten, GoesRoundAClosedChainFromItsFirstHeldNode) {
  std::vector<Vector3> nodes = arc(places(Spacing::even, 40), 360 * degree);
  nodes.pop_back();
  Constraints constraints(40);
  for (const Index node : {4, 14, 29}) hold(constraints, nodes, node);
  auto levels = levels_of(nodes, constraints, true, Distribution::even);
  start_from_chords(levels[0].net);
  const auto result = scatter_positions(levels[0].net, nodes, constraints, 1);
  for (std::size_t i = 29; i <= 44; ++i) {
    const double share = (static_cast<double>(i) - 29) / 15;
    EXPECT_LT((result[i % 40] - (nodes[29] + share * (nodes[4] - nodes[29]))).norm(), 1e-14) << i;
  }
}

}  // namespace
}  // namespace vspring::curve_levels_test
