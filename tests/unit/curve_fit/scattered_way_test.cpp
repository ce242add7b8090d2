// The way that scattered points say a curve goes.

#include "curve_fit/scattered_way.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace vspring {
namespace {

DenseCurve curve_of(const std::vector<Vector3>& places, bool closed) {
  std::vector<DenseCurve::Node> nodes;
  for (const Vector3& place : places) nodes.emplace_back().place = place;
  DenseCurve curve;
  curve.add_chain(nodes, closed);
  return curve;
}

TEST(ScatteredWay, GoesThroughPointsInTheirOrderAndCarriesTheCurveAlongBetweenThem) {
  std::vector<Vector3> line;
  for (int k = 0; k <= 10; ++k) line.emplace_back(k, 0, 0);
  const DenseCurve curve = curve_of(line, false);
  // In no order; 1 above the line at 2, 3 above at 8.
  const std::vector<CurvePoint> points = {{{8, 3, 0}, 1, {8, 0}, 0, 0}, {{2, 1, 0}, 1, {2, 0}, 1, 0}};
  const std::vector<CurvePoint> way = way_of_scattered(curve, points, 1.5);
  const std::vector<Vector3> expected = {{0, 1, 0},           {2, 1, 0}, {4, 1 + 2.0 / 3, 0},
                                         {6, 1 + 4.0 / 3, 0}, {8, 3, 0}, {10, 3, 0}};
  ASSERT_EQ(way.size(), expected.size());
  for (std::size_t k = 0; k < way.size(); ++k) {
    EXPECT_LT((way[k].place - expected[k]).norm(), 1e-12) << k;
    EXPECT_EQ(way[k].weight > 0, k == 1 || k == 4);
    EXPECT_EQ(way[k].number, -1);
  }
  // Near each other they tell all.
  EXPECT_EQ(way_of_scattered(curve, points, 20).size(), 2U);
  EXPECT_TRUE(way_of_scattered(curve, {}, 1).empty());
}

TEST(ScatteredWay, GoesAroundAClosedCurve) {
  constexpr int count = 40;
  std::vector<Vector3> ring;
  ring.reserve(count);
  for (int k = 0; k < count; ++k)
    ring.emplace_back(std::cos(2 * std::numbers::pi * k / count), std::sin(2 * std::numbers::pi * k / count), 0);
  const DenseCurve curve = curve_of(ring, true);
  const std::vector<CurvePoint> points = {{1.2 * ring[10], 1, {10, 0}, 0, 0}, {1.2 * ring[15], 1, {15, 0}, 1, 0}};
  const std::vector<CurvePoint> way = way_of_scattered(curve, points, 0.3);
  // Each further on than the one before, and none far from the next, across the seam too.
  ASSERT_GE(way.size(), 15U);
  for (std::size_t k = 0; k < way.size(); ++k) {
    const CurvePoint& next = way[(k + 1) % way.size()];
    if (k + 1 < way.size()) EXPECT_LT(way[k].at.edge + way[k].at.share, next.at.edge + next.at.share);
    EXPECT_LT((next.place - way[k].place).norm(), 0.9);
  }
}

TEST(ScatteredWay, GoesThroughHeldNodes) {
  std::vector<DenseCurve::Node> nodes(11);
  for (int k = 0; k <= 10; ++k) nodes[static_cast<std::size_t>(k)].place = Vector3(k, 0, 0);
  nodes.front().held = nodes.back().held = true;
  DenseCurve curve;
  curve.add_chain(nodes, false);
  const std::vector<CurvePoint> points = {{{5, 1, 0}, 1, {5, 0}, 0, 0}};
  const std::vector<CurvePoint> way = way_of_scattered(curve, points, 0.5);
  ASSERT_EQ(way.size(), 11U);
  for (std::size_t k = 0; k < way.size(); ++k)
    EXPECT_NEAR(way[k].place.y(), 1 - std::abs(static_cast<double>(k) - 5) / 5, 1e-12);
}

}  // namespace
}  // namespace vspring
