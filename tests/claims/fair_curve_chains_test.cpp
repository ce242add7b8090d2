// Closed chains, several chains, chains that meet, and regions.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_chains_test {
namespace {

using namespace support;

/// An ellipse of the axes 3 and 2, lifted at the second and third quarter.
std::vector<Vector3> oval(int count) {
  std::vector<Vector3> nodes;
  for (int k = 0; k < count; ++k) {
    const double angle = 360 * degree * k / count;
    nodes.emplace_back(3 * std::cos(angle), 2 * std::sin(angle), 0.4 * std::sin(2 * angle));
  }
  return nodes;
}

Vector3 curvature(const std::vector<Vector3>& nodes, std::size_t i) {
  const std::size_t count = nodes.size();
  const Vector3 a = nodes[i] - nodes[(i + count - 1) % count];
  const Vector3 b = nodes[(i + 1) % count] - nodes[i];
  const Vector3 tangent = (a / a.squaredNorm() + b / b.squaredNorm()).normalized();
  return 2 * a.cross(b).cross(tangent) / (a.norm() * b.norm() * (a + b).norm());
}

TEST(FairCurveChains, WhereAClosedChainBeginsDoesNotMatter) {
  const int count = 80;
  const auto nodes = oval(count);
  Constraints constraints(count);
  for (const Index i : {7, 23, 40, 66}) hold(constraints, nodes, i);
  const auto start = noisy(nodes, constraints, 0.05, 2, false);
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    const auto expected = fair(PolygonCurve(start, true), constraints, to_the_end(distribution)).positions;
    EXPECT_GT(greatest_distance(expected, start), 0.05);
    for (const int shift : {1, 7, 30, 79}) {
      PolygonCurve::Chain chain = {.nodes = std::vector<Index>(count), .closed = true};
      std::iota(chain.nodes.begin(), chain.nodes.end(), 0);
      std::rotate(chain.nodes.begin(), chain.nodes.begin() + shift, chain.nodes.end());
      const auto result = fair(PolygonCurve(start, {chain}), constraints, to_the_end(distribution)).positions;
      EXPECT_LT(greatest_distance(result, expected), 1e-11) << shift;
    }
  }
}

TEST(FairCurveChains, AClosedChainIsSmoothAtItsFirstNode) {
  // The step of the curvature from node to node halves with their spacing, at the first node, too.
  for (const Index first_held : {0, 5}) {
    std::vector<double> step;
    for (const int share : {1, 2, 4}) {
      const int count = 80 * share;
      const auto nodes = oval(count);
      Constraints constraints(count);
      for (const Index i : {first_held, 23, 40, 66}) hold(constraints, nodes, i * share);
      const auto result = fair(PolygonCurve(nodes, true), constraints, to_the_end()).positions;
      double greatest = 0;
      for (const std::size_t i : {nodes.size() - 2, nodes.size() - 1, std::size_t{0}, std::size_t{1}})
        greatest = std::max(greatest, (curvature(result, (i + 1) % nodes.size()) - curvature(result, i)).norm());
      step.push_back(greatest);
    }
    SCOPED_TRACE(fmt::format("{:.2e} {:.2e} {:.2e}", step[0], step[1], step[2]));
    EXPECT_LT(step[2], 0.03);
    EXPECT_GT(order(step[0], step[1]), 0.9);
    EXPECT_GT(order(step[1], step[2]), 0.9);
  }
}

TEST(FairCurveChains, SeveralChainsAreFairedEachOnItsOwn) {
  const int count = 60;
  const auto loop = oval(count);
  const auto line = straight({0, 0, 5}, {4, 1, 5}, places(Spacing::random, 50));
  Constraints of_loop(count);
  for (const Index i : {3, 20, 44}) hold(of_loop, loop, i);
  const Constraints of_line = held_ends(line, {1, 1, 0}, {1, -1, 1});
  const auto loop_alone = fair(PolygonCurve(loop, true), of_loop, to_the_end()).positions;
  const auto line_alone = faired(line, of_line);

  auto nodes = loop;
  nodes.insert(nodes.end(), line.begin(), line.end());
  Constraints both(static_cast<Index>(nodes.size()));
  for (const Index i : {3, 20, 44}) hold(both, nodes, i);
  hold(both, nodes, count);
  both.fix_tangent(count, {1, 1, 0});
  hold(both, nodes, count + 50);
  both.fix_tangent(count + 50, {1, -1, 1});
  PolygonCurve::Chain first = {.nodes = std::vector<Index>(loop.size()), .closed = true};
  PolygonCurve::Chain second = {.nodes = std::vector<Index>(line.size()), .closed = false};
  std::iota(first.nodes.begin(), first.nodes.end(), 0);
  std::iota(second.nodes.begin(), second.nodes.end(), count);
  const auto result = fair(PolygonCurve(nodes, {first, second}), both, to_the_end()).positions;
  EXPECT_LT(greatest_distance({result.begin(), result.begin() + count}, loop_alone), 1e-11);
  EXPECT_LT(greatest_distance({result.begin() + count, result.end()}, line_alone), 1e-11);
}

TEST(FairCurveChains, ChainsThatMeetAtAHeldNodeDoNotFeelEachOther) {
  // Three arms from one node, two of which have tangents there by their own chains' ends only.
  std::vector<Vector3> nodes = {Vector3(0, 0, 0)};
  std::vector<PolygonCurve::Chain> chains;
  std::vector<Vector3> ends = {{2, 0, 0}, {-1, 2, 0}, {-1, -2, 1}};
  for (const Vector3& end : ends) {
    PolygonCurve::Chain chain;
    for (const Vector3& node : straight(nodes[0], end, places(Spacing::even, 30))) {
      chain.nodes.push_back(chain.nodes.empty() ? 0 : static_cast<Index>(nodes.size()));
      if (chain.nodes.back() != 0) nodes.push_back(node);
    }
    chains.push_back(chain);
  }
  Constraints constraints(static_cast<Index>(nodes.size()));
  hold(constraints, nodes, 0);
  for (const auto& chain : chains) {
    hold(constraints, nodes, chain.nodes.back());
    constraints.fix_tangent(chain.nodes.back(), {0, 1, 1});
  }
  const auto result = fair(PolygonCurve(nodes, chains), constraints, to_the_end()).positions;
  for (const auto& chain : chains) {
    std::vector<Vector3> arm;
    std::vector<Vector3> of_all;
    for (const Index i : chain.nodes) {
      arm.push_back(nodes[static_cast<std::size_t>(i)]);
      of_all.push_back(result[static_cast<std::size_t>(i)]);
    }
    Constraints own = held_ends(arm);
    own.fix_tangent(own.node_count() - 1, {0, 1, 1});
    EXPECT_LT(greatest_distance(of_all, faired(arm, own)), 1e-11);
    EXPECT_GT(greatest_distance(of_all, arm), 0.05);
  }
}

TEST(FairCurveChains, ABumpOnAnArcFairedAsARegionGoes) {
  for (const bool closed : {false, true}) {
    for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
      const int count = 120;
      std::vector<Vector3> nodes;
      std::vector<Index> region;
      const auto at = places(Spacing::random, count, 2);
      for (Index i = 0; i < count; ++i) {
        const double angle = (closed ? 360 : 200) * degree * at[static_cast<std::size_t>(i)];
        nodes.push_back(heading(angle));
        // Across the first node where closed.
        const int from_middle = closed ? (i < 60 ? i : i - count) : i - 60;
        if (std::abs(from_middle) > 20) continue;
        region.push_back(i);
        nodes.back() += 0.1 * std::exp(-0.03 * from_middle * from_middle) * Vector3(1, 0.5, 1);
      }
      const PolygonCurve curve(nodes, closed);
      Constraints constraints(count);
      restrict_to_region(constraints, curve, region);
      const FairResult result = fair(curve, constraints, to_the_end(distribution));
      EXPECT_EQ(result.report.moving_nodes, 41);
      for (Index i = 0; i < count; ++i) {
        const Vector3& p = result.positions[static_cast<std::size_t>(i)];
        EXPECT_LT(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()), 1e-10);
        if (std::find(region.begin(), region.end(), i) != region.end()) continue;
        EXPECT_EQ(p, nodes[static_cast<std::size_t>(i)]);
      }
    }
  }
}

}  // namespace
}  // namespace vspring::fair_curve_chains_test
