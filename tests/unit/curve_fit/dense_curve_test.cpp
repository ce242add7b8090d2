#include "curve_fit/dense_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace vspring::dense_curve_test {
namespace {

/// Uneven places on the unit circle, to that angle.
DenseCurve on_circle(double angle) {
  std::vector<DenseCurve::Node> nodes;
  double at = 0;
  while (at < angle) {
    nodes.emplace_back().place = {std::cos(at), std::sin(at), 0};
    at += nodes.size() % 2 == 1 ? 0.2 : 0.1;
  }
  DenseCurve curve;
  curve.add_chain(nodes, false);
  return curve;
}

TEST(DenseCurve, IsACircleWhereItsNodesLieOnOne) {
  const DenseCurve curve = on_circle(2);
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.is_edge(i)) continue;
    EXPECT_NEAR(curve.bend(i, true).curvature.norm(), 1, 1e-12);
    for (const double share : {0.25, 0.5, 0.75}) EXPECT_NEAR(curve.at({i, share}).norm(), 1, 1e-7);
  }
}

TEST(DenseCurve, CurvatureIsLinearBetweenNodesOfAnEulerSpiral) {
  constexpr int steps = 100;
  std::vector<DenseCurve::Node> nodes;
  std::vector<double> lengths;
  Vector3 place = Vector3::Zero();
  double way = -1;
  while (way < 1.5) {
    nodes.emplace_back().place = place;
    lengths.push_back(way);
    const double edge = nodes.size() % 2 == 1 ? 0.14 : 0.1;
    for (int k = 0; k < steps; ++k) {
      const double middle = way + edge / steps * (k + 0.5);
      place += edge / steps * Vector3(std::cos(middle * middle / 2), std::sin(middle * middle / 2), 0);
    }
    way += edge;
  }
  DenseCurve curve;
  curve.add_chain(nodes, false);
  for (std::uint32_t i = 2; i + 3 < curve.size(); ++i) {
    for (const double share : {0.25, 0.5, 0.75}) {
      const Vector3 here = curve.at({i, share});
      const double curvature =
          circle_curvature(curve.at({i, share + 0.1}) - here, curve.at({i, share - 0.1}) - here).norm();
      EXPECT_NEAR(curvature, std::abs(lengths[i] + share * (lengths[i + 1] - lengths[i])), 0.02);
    }
  }
}

TEST(DenseCurve, NearestIsTheFootOnTheCurveAndNotOnItsChord) {
  const DenseCurve curve = on_circle(2);
  const Vector3 point = 1.3 * Vector3(std::cos(0.85), std::sin(0.85), 0);
  const CurvePlace place = curve.nearest(point, {0, 0}, 10);
  EXPECT_NEAR((curve.at(place) - point).norm(), 0.3, 1e-6);
}

TEST(DenseCurve, NearestWhereStationsStayIsTheOneWithTheSameStation) {
  std::vector<DenseCurve::Node> nodes;
  for (int k = 0; k <= 20; ++k) nodes.emplace_back().place = {0.1 * k, std::sin(0.2 * k), 0};
  DenseCurve curve(false, {0, 1, 0});
  curve.add_chain(nodes, false);
  const Vector3 point(1.234, 5, 0);
  const CurvePlace place = curve.nearest(point, {0, 0}, 10);
  EXPECT_NEAR(curve.at(place).x(), point.x(), 1e-6);
  EXPECT_EQ(curve.offset(place, point).x(), 0);
  EXPECT_NEAR(curve.offset(place, point).y(), std::sin(2 * point.x()) - 5, 1e-3);
  curve.set_place(3, {7, 8, 9});
  EXPECT_EQ(curve.place(3), Vector3(nodes[3].place.x(), 8, 0));
}

TEST(DenseCurve, CurvatureRowsAreItsDerivatives) {
  DenseCurve curve = on_circle(1);
  const auto row = curve.curvature_row(2, true);
  ASSERT_EQ(row.count, 3);
  const double step = 1e-6;
  for (int n = 0; n < 3; ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto node = row.nodes[static_cast<std::size_t>(n)];
      const Vector3 place = curve.place(node);
      Vector3 moved = place;
      moved[axis] += step;
      curve.set_place(node, moved);
      const Vector3 slope = (curve.curvature_row(2, true).curvature - row.curvature) / step;
      curve.set_place(node, place);
      EXPECT_LT((slope - row.slopes[static_cast<std::size_t>(n)].col(axis)).norm(), 1e-3) << n << axis;
    }
  }
}

}  // namespace
}  // namespace vspring::dense_curve_test
