#include "start/smooth_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/curves.hpp"

namespace vspring::smooth_start_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

/// The k of a smoothing length of so many edges.
double pull_over(double edges) { return std::pow(edges, -4) / 8; }

struct Start {
  std::vector<Vector3> nodes;
  Constraints constraints;
  bool closed = false;

  /// With a point for every node that moves.
  [[nodiscard]] std::vector<Vector3> from(const std::vector<Vector3>& points, double pull) const {
    Net net = gather_net(PolygonCurve(nodes, closed), constraints);
    for (std::size_t i = 0; i < net.positions.size(); ++i) {
      net.points.begin.push_back(static_cast<std::uint32_t>(net.points.order.size()));
      if (i >= net.moving) continue;
      net.points.order.push_back(static_cast<std::uint32_t>(i));
      net.points.positions.push_back(net.frame.to_local(points[static_cast<std::size_t>(net.node[i])]));
      net.points.weights.push_back(1);
    }
    net.points.begin.push_back(static_cast<std::uint32_t>(net.points.order.size()));
    start_smooth(net, std::vector<double>(net.moving, pull));
    return scatter_positions(net, nodes, constraints, 1);
  }
};

Start line(int edges) {
  const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges));
  return {nodes, held_ends(nodes)};
}

double greatest_turn(const std::vector<Vector3>& nodes) {
  double greatest = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const Vector3 before = nodes[i] - nodes[i - 1];
    const Vector3 after = nodes[i + 1] - nodes[i];
    greatest = std::max(greatest, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return greatest;
}

TEST(StartSmooth, IsFarSmootherThanLargeNoise) {
  const Start start = line(100);
  // Of five edges.
  const auto points = noisy(start.nodes, start.constraints, 0.05, 1, false);
  EXPECT_GT(greatest_turn(points), 150 * degree);
  const auto result = start.from(points, pull_over(10));
  EXPECT_LT(greatest_turn(result), 8 * degree);
  EXPECT_LT(greatest_distance(result, start.nodes), 0.03);
  EXPECT_EQ(result.front(), start.nodes.front());
  EXPECT_EQ(result.back(), start.nodes.back());
}

TEST(StartSmooth, KeepsTheShareOfWavesThatTheSmoothingLengthAsksFor) {
  const Start start = line(120);
  for (const int waves : {2, 4, 8}) {
    for (const double edges : {4.0, 8.0}) {
      std::vector<Vector3> points = start.nodes;
      for (Vector3& p : points) p.y() = 0.01 * std::sin(2 * pi * waves * p.x());
      double sum = 0;
      for (const Vector3& p : start.from(points, pull_over(edges))) sum += p.y() * std::sin(2 * pi * waves * p.x());
      EXPECT_NEAR(2 * sum / 120 / 0.01, 1 / (1 + std::pow(edges / 120 * 2 * pi * waves, 4)), 0.01);
    }
  }
}

TEST(SmoothNear, KeepsTheShareOfWavesThatTheSmoothingLengthAsksFor) {
  for (const Spacing spacing : {Spacing::even, Spacing::alternating}) {
    auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(spacing, 400));
    for (Vector3& p : nodes) p.y() = 0.001 * std::sin(8 * pi * p.x());
    for (const double length : {0.02, 0.05, 0.2}) {
      Net net = gather_net(PolygonCurve(nodes), held_ends(nodes));
      ASSERT_TRUE(smooth_near(net, net.positions, length * net.frame.scale()));
      const auto result = scatter_positions(net, nodes, held_ends(nodes), 1);
      double products = 0;
      double squares = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        products += result[i].y() * nodes[i].y();
        squares += nodes[i].y() * nodes[i].y();
      }
      EXPECT_NEAR(products / squares, 1 / (1 + std::pow(8 * pi * length, 4)), 0.005);
    }
  }
}

TEST(StartSmooth, SmoothsByNoMoreThanThirtyEdges) {
  const Start start = line(100);
  std::vector<Vector3> points = start.nodes;
  for (Vector3& p : points) p.y() = 0.1 * std::sin(pi * p.x());
  const auto least = start.from(points, 0);
  EXPECT_NEAR(least[50].y(), 0.1 / (1 + std::pow(0.33 * pi, 4)), 0.003);
  EXPECT_LT(greatest_distance(least, start.from(points, pull_over(1000))), 1e-12);
}

TEST(StartSmooth, KeepsGivenTangentsAndHeldNodes) {
  Start start = line(100);
  const Vector3 first = heading(20 * degree);
  const Vector3 last = heading(-10 * degree);
  start.constraints = held_ends(start.nodes, first, last);
  start.constraints.fix_position(40, {0.4, 0.03, 0});
  const auto result = start.from(noisy(start.nodes, start.constraints, 0.03, 2, true), pull_over(10));
  EXPECT_EQ(result[0], start.nodes[0]);
  EXPECT_EQ(result[40], Vector3(0.4, 0.03, 0));
  EXPECT_EQ(result[100], start.nodes[100]);
  // As the curve goes on into the ends.
  const auto direction = [&](std::size_t i, std::size_t beside, std::size_t next) {
    const Vector3 one = result[beside] - result[i];
    const Vector3 two = result[next] - result[i];
    return Vector3((4 * one - two).normalized());
  };
  EXPECT_LT((direction(0, 1, 2) - first).norm(), 1e-2);
  EXPECT_LT((direction(100, 99, 98) + last).norm(), 1e-2);
}

TEST(StartSmooth, HugePullGoesThroughThePoints) {
  const Start start = line(60);
  const auto points = noisy(start.nodes, start.constraints, 0.05, 3, false);
  EXPECT_LT(greatest_distance(start.from(points, 1e8), points), 1e-8);
}

TEST(StartSmooth, GoesRoundClosedCurves) {
  Start start{.nodes = {}, .constraints = Constraints(90), .closed = true};
  for (int k = 0; k < 90; ++k) start.nodes.push_back(heading(2 * pi * k / 90));
  const auto points = noisy(start.nodes, start.constraints, 0.1, 4, false);
  const auto result = start.from(points, pull_over(6));
  std::vector<Vector3> round = result;
  round.insert(round.end(), result.begin(), result.begin() + 2);
  EXPECT_LT(greatest_turn(round), 12 * degree);
  EXPECT_LT(greatest_distance(result, start.nodes), 0.1);
}

}  // namespace
}  // namespace vspring::smooth_start_test
