#include "vspring/resample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "vspring/error.hpp"

namespace vspring::resample_test {
namespace {

Vector3 on_circle(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

/// An arc of 120° whose nodes lie ever closer.
PolygonCurve uneven_arc() {
  std::vector<Vector3> positions;
  for (int k = 0; k <= 30; ++k) positions.push_back(on_circle(2.1 * std::pow(k / 30.0, 2)));
  return PolygonCurve(std::move(positions));
}

std::vector<double> edges_of(const PolygonCurve& curve) {
  std::vector<double> edges;
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k)
      edges.push_back((curve.position(chain.nodes[(k + 1) % count]) - curve.position(chain.nodes[k])).norm());
  }
  return edges;
}

double spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most / *least;
}

TEST(Resample, GivesTheNumberOfNodesEvenlyOnTheCurve) {
  const PolygonCurve arc = uneven_arc();
  const Resampled even = resample(arc, Constraints(arc.node_count()), {.nodes = 101});
  ASSERT_EQ(even.curve.node_count(), 101);
  EXPECT_LT(spread(edges_of(even.curve)), 1.002);
  for (const Vector3& position : even.curve.positions()) EXPECT_NEAR(position.norm(), 1, 1e-6);
  EXPECT_EQ(even.curve.position(0), arc.position(0));
  EXPECT_EQ(even.curve.position(100), arc.position(30));
  EXPECT_EQ(even.from.front(), 0);
  EXPECT_EQ(even.from.back(), 30);
  EXPECT_EQ(even.from[50], -1);
}

TEST(Resample, SpacingIsMetAsNearlyAsWholeNumbersAllow) {
  const PolygonCurve arc = uneven_arc();
  const Resampled even = resample(arc, Constraints(arc.node_count()), {.spacing = 0.1});
  EXPECT_EQ(even.curve.node_count(), 22);
  for (const double edge : edges_of(even.curve)) EXPECT_NEAR(edge, 0.1, 1e-3);
}

TEST(Resample, KeepsHeldNodesWithWhatHoldsThem) {
  const PolygonCurve arc = uneven_arc();
  Constraints constraints(arc.node_count());
  constraints.fix_position(10, Vector3(2, 2, 0));
  constraints.fix_tangent(10, Vector3(0, 1, 0));
  constraints.fix_normal(20, Vector3(1, 0, 0));
  const Resampled even = resample(arc, constraints, {.nodes = 50});
  ASSERT_EQ(even.curve.node_count(), 50);
  const auto at = [&](Index from) {
    return static_cast<Index>(std::find(even.from.begin(), even.from.end(), from) - even.from.begin());
  };
  EXPECT_EQ(even.curve.position(at(10)), Vector3(2, 2, 0));
  EXPECT_EQ(even.constraints.tangent(at(10)), Vector3(0, 1, 0));
  EXPECT_TRUE(even.constraints.position_fixed(at(10)));
  EXPECT_EQ(even.curve.position(at(20)), arc.position(20));
  EXPECT_EQ(even.constraints.normal(at(20)), Vector3(1, 0, 0));
  EXPECT_EQ(std::count_if(even.from.begin(), even.from.end(), [](Index from) { return from >= 0; }), 4);
}

TEST(Resample, ClosedChainsStayClosedAndMeetingOnesMeet) {
  std::vector<Vector3> positions;
  positions.reserve(13);
  for (int k = 0; k < 12; ++k) positions.push_back(on_circle(std::numbers::pi * k / 6));
  positions.emplace_back(3, 0, 0);
  PolygonCurve::Chain ring{.nodes = {}, .closed = true};
  for (Index k = 0; k < 12; ++k) ring.nodes.push_back(k);
  const PolygonCurve curve(positions, {ring, {.nodes = {6, 12}, .closed = false}});
  const Resampled even = resample(curve, Constraints(13), {.spacing = 0.1});
  ASSERT_EQ(even.curve.chains().size(), 2U);
  EXPECT_TRUE(even.curve.chains()[0].closed);
  EXPECT_EQ(even.curve.chains()[0].nodes.size(), 63U);
  EXPECT_EQ(even.curve.chains()[1].nodes.size(), 41U);
  // The node where the two meet is one node still.
  EXPECT_EQ(even.curve.chains()[0].nodes.front(), even.curve.chains()[1].nodes.front());
  EXPECT_EQ(even.curve.node_count(), 63 + 40);
  const Resampled counted = resample(curve, Constraints(13), {.nodes = 47});
  EXPECT_EQ(counted.curve.node_count(), 47);
}

TEST(Resample, RefusesWhatCannotBe) {
  const PolygonCurve arc = uneven_arc();
  const Constraints free(arc.node_count());
  const auto code = [](auto call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::unusable_file;
  };
  const auto refuses = [&](const Resampling& how) {
    return code([&] { (void)resample(arc, free, how); }) == ErrorCode::invalid_argument;
  };
  EXPECT_TRUE(refuses({}));
  EXPECT_TRUE(refuses({.nodes = 10, .spacing = 1.0}));
  EXPECT_TRUE(refuses({.nodes = 1}));
  EXPECT_TRUE(refuses({.spacing = 0.0}));
  EXPECT_TRUE(refuses({.spacing = 1e-12}));
  EXPECT_TRUE(refuses({.spacing = std::numeric_limits<double>::quiet_NaN()}));
  std::vector<Vector3> positions = arc.positions();
  positions[3].x() = std::numeric_limits<double>::infinity();
  const PolygonCurve broken(positions);
  EXPECT_EQ(code([&] { (void)resample(broken, free, {.nodes = 10}); }), ErrorCode::unusable_shape);
}

TEST(Resample, NodesInOnePlaceAreNoHindrance) {
  const PolygonCurve point(std::vector<Vector3>(5, Vector3(1, 1, 1)));
  const Resampled even = resample(point, Constraints(5), {.nodes = 7});
  EXPECT_EQ(even.curve.node_count(), 7);
  for (const Vector3& position : even.curve.positions()) EXPECT_EQ(position, Vector3(1, 1, 1));
}

PolygonCurve segment(const Vector3& to) {
  std::vector<Vector3> positions;
  for (const double at : {0.0, 0.1, 0.15, 0.6, 1.0}) positions.emplace_back(at * to);
  return PolygonCurve(std::move(positions));
}

PolygonCurve ellipse(double width, double height) {
  std::vector<Vector3> positions;
  for (int k = 0; k < 400; ++k) {
    const Vector3 p = on_circle(2 * std::numbers::pi * k / 400);
    positions.emplace_back(width * p.x(), height * p.y(), 0);
  }
  return PolygonCurve(std::move(positions), true);
}

TEST(ResampleByCosine, IsThatOfTablesOnAStraightLine) {
  const PolygonCurve line = segment({3, 4, 0});
  const Resampled result = resample(line, Constraints(5), {.nodes = 41, .by = ResamplingBy::cosine});
  ASSERT_EQ(result.curve.node_count(), 41);
  for (Index k = 0; k <= 40; ++k) {
    const double at = (1 - std::cos(std::numbers::pi * k / 40)) / 2;
    EXPECT_LT((result.curve.position(k) - at * Vector3(3, 4, 0)).norm(), 5e-3) << k;
  }
}

TEST(ResampleByCosine, NodesAreCloseAtTheEndsAndAtTheNose) {
  // From the tail over the upper side, the nose and the lower side back to the tail.
  std::vector<Vector3> positions;
  for (int k = 0; k <= 300; ++k) {
    const double angle = 2 * std::numbers::pi * k / 300;
    const double x = (1 + std::cos(angle)) / 2;
    positions.emplace_back(x, (angle < std::numbers::pi ? 0.2 : -0.2) * std::sqrt(x) * (1 - x), 0);
  }
  const PolygonCurve foil(std::move(positions));
  const Resampled result = resample(foil, Constraints(301), {.nodes = 81, .by = ResamplingBy::cosine});
  ASSERT_EQ(result.curve.node_count(), 81);
  const std::vector<double> edges = edges_of(result.curve);
  const auto nose =
      static_cast<std::size_t>(std::min_element(result.curve.positions().begin(), result.curve.positions().end(),
                                                [](const Vector3& a, const Vector3& b) { return a.x() < b.x(); }) -
                               result.curve.positions().begin());
  EXPECT_NEAR(static_cast<double>(nose), 40, 1);
  const double side = edges[20];
  EXPECT_NEAR(edges[60], side, 0.05 * side);
  for (const std::size_t k : {std::size_t{0}, nose - 1, nose, edges.size() - 1}) EXPECT_LT(edges[k], 0.1 * side) << k;
  for (std::size_t k = 1; k < 20; ++k) EXPECT_GT(edges[k], edges[k - 1]) << k;
  for (std::size_t k = 21; k < 38; ++k) EXPECT_LT(edges[k], edges[k - 1]) << k;
}

TEST(ResampleByCurvature, NodesAreCloserWhereTheCurveIsBentMore) {
  const PolygonCurve curve = ellipse(10, 1);
  const Resampled result = resample(curve, Constraints(400), {.nodes = 120, .by = ResamplingBy::curvature});
  ASSERT_EQ(result.curve.node_count(), 120);
  const std::vector<double> edges = edges_of(result.curve);
  double sharp = 0;
  double flat = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double x = std::abs(result.curve.position(static_cast<Index>(k)).x());
    if (x > 9.9) sharp = std::max(sharp, edges[k]);
    if (x < 5) flat = std::min(flat, edges[k]);
    const double ratio = edges[(k + 1) % edges.size()] / edges[k];
    EXPECT_LE(std::max(ratio, 1 / ratio), 1.4) << k;
  }
  EXPECT_GT(sharp, 0);
  EXPECT_LT(2 * sharp, flat);
  for (const Vector3& p : result.curve.positions()) EXPECT_NEAR(std::hypot(p.x() / 10, p.y()), 1, 1e-3);
}

TEST(ResampleByCurvature, StraightLinesAndCirclesStayEven) {
  const PolygonCurve line = segment({3, 4, 0});
  const Resampled straight = resample(line, Constraints(5), {.nodes = 41, .by = ResamplingBy::curvature});
  ASSERT_EQ(straight.curve.node_count(), 41);
  EXPECT_LT(spread(edges_of(straight.curve)), 1.001);
  const Resampled round = resample(ellipse(1, 1), Constraints(400), {.spacing = 0.1, .by = ResamplingBy::curvature});
  EXPECT_EQ(round.curve.node_count(), 63);
  EXPECT_LT(spread(edges_of(round.curve)), 1.01);
}

TEST(Resample, WhatDoesNotFitTheCurveIsRefused) {
  const PolygonCurve curve(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}});
  const Constraints constraints(curve.node_count());
  EXPECT_THROW(std::ignore = resample(curve, Constraints(2), {.nodes = 9}), Error);
  for (const Index nodes : {Index{0}, Index{-1}, std::numeric_limits<Index>::max()})
    EXPECT_THROW(std::ignore = resample(curve, constraints, {.nodes = nodes}), Error) << nodes;
}

}  // namespace
}  // namespace vspring::resample_test
