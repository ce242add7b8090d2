#include "curve_fit/gentle_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "curve_fit/planar_polygon.hpp"
#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::gentle_curve_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;
constexpr std::size_t any = std::numeric_limits<std::size_t>::max();

std::optional<std::vector<Vector3>> gentle(const PolygonCurve& start, const Constraints& constraints,
                                           const std::vector<Vector3>& points, double tolerance,
                                           std::size_t most_extremes = any) {
  Context context;
  return gentle_curve(start, constraints, points, tolerance, most_extremes, context);
}

PolygonCurve with(const PolygonCurve& curve, const std::vector<Vector3>& positions) {
  PolygonCurve result = curve;
  result.set_positions(positions);
  return result;
}

std::vector<Vector3> arc(int nodes, double angle, double noise) {
  std::vector<Vector3> places;
  Draw draw(5);
  for (int k = 0; k < nodes; ++k) {
    const double at = angle * k / (nodes - 1);
    Vector3 off = k == 0 || k + 1 == nodes ? Vector3(Vector3::Zero()) : draw.in_cube(noise);
    off.z() = 0;
    places.emplace_back(Vector3(std::sin(at), 1 - std::cos(at), 0) + off);
  }
  return places;
}

TEST(GentleCurve, IsACircleWithinTheNoiseOfOneUpToItsFreeEnds) {
  const std::vector<Vector3> points = arc(60, 2, 0.002);
  const PolygonCurve curve(points);
  const auto found = gentle(curve, held_ends(points), points, 0.004);
  ASSERT_TRUE(found.has_value());
  const PolygonCurve after = with(curve, *found);
  EXPECT_LE(distance(points, after).greatest, 0.004);
  const CurveFigures figures = measure_curve(after);
  EXPECT_EQ(figures.curvature_extrema, 0);
  EXPECT_LT(figures.curvature_variation, 1e-2);
  // Not without curvature, as the ends of springs are.
  const std::vector<double> bent = curvatures(after);
  EXPECT_NEAR(bent[1], 1, 0.03);
  EXPECT_NEAR(bent[58], 1, 0.03);
  EXPECT_EQ(found->front(), points.front());
  EXPECT_EQ(found->back(), points.back());
}

TEST(GentleCurve, GoesAroundAClosedCurveWithoutASeam) {
  std::vector<Vector3> points;
  Draw draw(6);
  for (int k = 0; k < 90; ++k) {
    const double angle = 2 * pi * k / 90;
    const double radius = 1 + 0.1 * std::cos(3 * angle) + draw.uniform(-0.003, 0.003);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  const PolygonCurve curve(points, true);
  const auto found = gentle(curve, Constraints(90), points, 0.006);
  ASSERT_TRUE(found.has_value());
  const CurveFigures figures = measure_curve(with(curve, *found));
  EXPECT_EQ(figures.curvature_extrema, 6);
  EXPECT_LE(figures.inflections, 6);
  EXPECT_LT(figures.curvature_variation, 0.05 * measure_curve(curve).curvature_variation);
}

TEST(GentleCurve, LeavesOutSwingsThatPointsDoNotAskFor) {
  // Straight, with a hump of half the tolerance.
  std::vector<Vector3> points;
  for (int k = 0; k <= 80; ++k) {
    const double x = k / 80.0;
    points.emplace_back(x, 0.25 * x * x + 0.0005 * std::exp(-std::pow((x - 0.5) / 0.05, 2)), 0);
  }
  const PolygonCurve curve(points);
  ASSERT_GE(measure_curve(curve).curvature_extrema, 3);
  const auto none = gentle(curve, held_ends(points), points, 0.001, 0);
  ASSERT_TRUE(none.has_value());
  EXPECT_EQ(measure_curve(with(curve, *none)).curvature_extrema, 0);
  // Where the points ask for them they stay.
  const auto kept = gentle(curve, held_ends(points), points, 0.00002, 0);
  ASSERT_TRUE(kept.has_value());
  EXPECT_GE(measure_curve(with(curve, *kept)).curvature_extrema, 3);
}

TEST(GentleCurve, KeepsGivenDirectionsAndHeldNodes) {
  std::vector<Vector3> points = arc(61, 2, 0.001);
  Constraints held = held_ends(points);
  held.fix_tangent(0, Vector3(std::cos(0.2), std::sin(0.2), 0));
  const Vector3 there = points[30] + Vector3(0.001, 0, 0);
  held.fix_position(30, there);
  std::vector<Vector3> start = points;
  start[30] = there;
  const PolygonCurve curve(start);
  const auto found = gentle(curve, held, points, 0.004);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ((*found)[30], there);
  const Vector3 first = ((*found)[1] - (*found)[0]).normalized();
  // Of an edge of 1/30 of a curvature of some 1 to 10.
  EXPECT_NEAR(std::atan2(first.y(), first.x()), 0.2, 0.1);
  EXPECT_GT(std::atan2(first.y(), first.x()), 0.08);
}

TEST(GentleCurve, IsNotForSpaceOrWhereNothingIsWithin) {
  std::vector<Vector3> points = arc(40, 2, 0);
  EXPECT_FALSE(gentle(PolygonCurve(std::vector<Vector3>{points[0], points[20], points[39]}),
                      held_ends({points[0], points[20], points[39]}), points, 0.001)
                   .has_value());
  points[20].z() = 0.1;
  EXPECT_FALSE(gentle(PolygonCurve(points), held_ends(points), points, 0.01).has_value());
}

TEST(PlanarPolygon, KnowsHowCurvatureGoesWithTheNodes) {
  std::vector<Vector3> places = arc(9, 2, 0.02);
  Constraints held = held_ends(places);
  held.fix_tangent(8, Vector3(0, 1, 0));
  auto polygon = PlanarPolygon::of(PolygonCurve(places), held, {});
  ASSERT_TRUE(polygon.has_value());
  const PlanarPolygon before = *polygon;
  constexpr double way = 1e-6;
  for (std::uint32_t node = 1; node < 8; ++node) {
    std::vector<Eigen::Vector2d> moved = before.places();
    moved[node] += way * before.normal(node);
    polygon->set_places(moved);
    const auto& stations = before.runs()[0].stations;
    ASSERT_EQ(stations.size(), 8U);
    for (std::size_t k = 0; k < stations.size(); ++k) {
      double slope = 0;
      for (std::size_t n = 0; n < 3; ++n) slope += stations[k].nodes[n] == node ? stations[k].slopes[n] : 0;
      const double change = (polygon->runs()[0].stations[k].curvature - stations[k].curvature) / way;
      EXPECT_NEAR(slope, change, 1e-3 * (1 + std::abs(change))) << "station " << k << ", node " << node;
    }
  }
}

}  // namespace
}  // namespace vspring::gentle_curve_test
