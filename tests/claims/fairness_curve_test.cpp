// Figures of curves against closed forms and known counts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "support/clothoid.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fairness_curve_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Parameters from begin to end, unevenly spaced: every third step is twice as long, and all swell.
std::vector<double> uneven(double begin, double end, int steps) {
  std::vector<double> at = {0};
  for (int k = 0; k < steps; ++k)
    at.push_back(at.back() + (k % 3 == 0 ? 2 : 1) * (1 + 0.5 * std::sin(6.0 * k / steps)));
  const double whole = at.back();
  for (double& t : at) t = begin + (end - begin) * t / whole;
  return at;
}

PolygonCurve sampled(double begin, double end, int steps, const std::function<Vector3(double)>& place,
                     bool closed = false) {
  std::vector<Vector3> positions;
  for (const double t : uneven(begin, end, steps)) positions.push_back(place(t));
  if (closed) positions.pop_back();
  return PolygonCurve(std::move(positions), closed);
}

using Member = double CurveFigures::*;

double order(const std::function<PolygonCurve(int)>& make, Member member, double exact) {
  const double coarse = std::abs(measure_curve(make(60)).*member / exact - 1);
  const double fine = std::abs(measure_curve(make(240)).*member / exact - 1);
  EXPECT_LT(fine, 5e-3);
  return std::log2(coarse / fine) / 2;
}

/// Curvature at the nodes of an ellipse, whose closed form is ab / (a² sin² + b² cos²)^(3/2): the error falls with the
/// square of the spacing.
TEST(CurveFigures, CurvatureAtNodes) {
  double last = 0;
  for (const int count : {50, 100, 200}) {
    std::vector<Vector3> nodes;
    nodes.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
      nodes.emplace_back(3e8 * std::cos(2 * pi * k / count), 2e8 * std::sin(2 * pi * k / count), 5e8);
    const std::vector<double> found = curvatures(PolygonCurve(nodes, true));
    double error = 0;
    for (int k = 0; k < count; ++k) {
      const double s = std::sin(2 * pi * k / count);
      const double c = std::cos(2 * pi * k / count);
      error = std::max(
          error, std::abs(found[static_cast<std::size_t>(k)] * 1e8 * std::pow(9 * s * s + 4 * c * c, 1.5) / 6 - 1));
    }
    EXPECT_LT(error, 30.0 / (count * count));
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.3);
    }
    last = error;
  }
  // Ends have none.
  const std::vector<double> open = curvatures(PolygonCurve({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}));
  EXPECT_EQ(open.front(), 0);
  EXPECT_EQ(open.back(), 0);
  EXPECT_NEAR(open[1], 1, 1e-15);
}

TEST(CurveFigures, OfAClothoidConvergeWithTheSquareOfTheSpacing) {
  const reference::Clothoid clothoid{.curvature = -1, .curvature_rate = 2, .length = 3};
  const auto make = [&](int steps) {
    return sampled(0, clothoid.length, steps, [&](double s) {
      const Eigen::Vector2d p = clothoid.at(s);
      return Vector3(p.x(), p.y(), 0);
    });
  };
  const double length = 3;
  // ∫ (−1 + 2s)² ds from 0 to 3 = (5³ + 1)/6.
  EXPECT_GT(order(make, &CurveFigures::bending_energy, length * 21), 1.8);
  EXPECT_GT(order(make, &CurveFigures::curvature_variation, std::pow(length, 3) * 12), 1.8);
  const CurveFigures figures = measure_curve(make(240));
  EXPECT_NEAR(figures.length, 3, 1e-3);
  EXPECT_NEAR(figures.greatest_curvature, 15, 0.2);
  EXPECT_EQ(figures.inflections, 1);
  EXPECT_EQ(figures.curvature_extrema, 0);
  EXPECT_GT(figures.neighbouring_edge_spread, 1.9);
}

TEST(CurveFigures, OfACircleHaveNoVariation) {
  const auto make = [](int steps) {
    return sampled(
        0, 2 * pi, steps, [](double t) { return Vector3(std::cos(t), std::sin(t), 0); }, true);
  };
  EXPECT_GT(order(make, &CurveFigures::bending_energy, 4 * pi * pi), 1.8);
  const CurveFigures figures = measure_curve(make(100));
  EXPECT_LT(figures.curvature_variation, 1e-15);
  EXPECT_EQ(figures.curvature_extrema, 0);
  EXPECT_EQ(figures.inflections, 0);
  const CurveFigures arc =
      measure_curve(sampled(0, 2, 50, [](double t) { return Vector3(1e6 + 3 * std::cos(t), 3 * std::sin(t), 5); }));
  EXPECT_LT(arc.curvature_variation, 1e-9);
}

TEST(CurveFigures, OfAHelix) {
  const double radius = 1;
  const double rise = 0.5;
  const double speed2 = radius * radius + rise * rise;
  const double curvature = radius / speed2;
  const double torsion = rise / speed2;
  const double length = 6 * std::sqrt(speed2);
  const auto make = [&](int steps) {
    return sampled(0, 6, steps,
                   [&](double t) { return Vector3(radius * std::cos(t), radius * std::sin(t), rise * t); });
  };
  EXPECT_GT(order(make, &CurveFigures::bending_energy, length * length * curvature * curvature), 1.8);
  // In a frame that does not turn, the curvature vector turns by the torsion.
  EXPECT_GT(order(make, &CurveFigures::curvature_variation, std::pow(length, 4) * std::pow(curvature * torsion, 2)),
            1.8);
  EXPECT_EQ(measure_curve(make(240)).inflections, 0);
}

TEST(CurveFigures, CountsOfKnownCurves) {
  const auto ellipse = sampled(
      0.3, 0.3 + 2 * pi, 200, [](double t) { return Vector3(2 * std::cos(t), std::sin(t), 0); }, true);
  EXPECT_EQ(measure_curve(ellipse).curvature_extrema, 4);
  EXPECT_EQ(measure_curve(ellipse).inflections, 0);
  const auto eight = sampled(
      0.3, 0.3 + 2 * pi, 400,
      [](double t) -> Vector3 {
        return Vector3(std::cos(t), std::sin(t) * std::cos(t), 0) / (1 + std::pow(std::sin(t), 2));
      },
      true);
  EXPECT_EQ(measure_curve(eight).curvature_extrema, 2);
  EXPECT_EQ(measure_curve(eight).inflections, 2);
  const auto wave = sampled(0, 4 * pi, 300, [](double t) { return Vector3(t, 0.5 * std::sin(t), 0); });
  EXPECT_EQ(measure_curve(wave).curvature_extrema, 4);
  EXPECT_EQ(measure_curve(wave).inflections, 3);
}

TEST(CurveFigures, RoundingIsNoExtreme) {
  const auto line = sampled(0, 1, 2000, [](double t) { return Vector3(t, 0.3 * t, 0.1 + 0.7 * t); });
  EXPECT_EQ(measure_curve(line).curvature_extrema, 0);
  EXPECT_EQ(measure_curve(line).inflections, 0);
  EXPECT_LT(measure_curve(line).bending_energy, 1e-10);
  // Straight, round, straight: flat runs have no extremes of their own.
  std::vector<Vector3> stadium;
  stadium.reserve(181);
  for (int k = 0; k < 50; ++k) stadium.emplace_back(-2 + 0.04 * k, -1, 0);
  for (int k = 0; k < 80; ++k) stadium.emplace_back(std::sin(pi * k / 80), -std::cos(pi * k / 80), 0);
  for (int k = 0; k <= 50; ++k) stadium.emplace_back(-0.04 * k, 1, 0);
  EXPECT_EQ(measure_curve(PolygonCurve(stadium)).curvature_extrema, 1);
  EXPECT_EQ(measure_curve(PolygonCurve(stadium)).inflections, 0);
}

TEST(CurveFigures, ScaleTurnReverseAndMirror) {
  const auto wave = sampled(0, 9, 120, [](double t) { return Vector3(t, std::sin(t), 0.3 * std::cos(1.7 * t)); });
  const auto before = list_figures(measure_curve(wave));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (int kind = 0; kind < 3; ++kind) {
    std::vector<Vector3> positions = wave.positions();
    const double scale = kind == 0 ? 1e3 : 1;
    for (Vector3& p : positions) {
      p = kind == 0 ? Vector3(scale * (turn * p) + Vector3(5, 6, 7)) : kind == 1 ? p : Vector3(-p.x(), p.y(), p.z());
    }
    if (kind == 1) std::reverse(positions.begin(), positions.end());
    const auto after = list_figures(measure_curve(PolygonCurve(positions)));
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (before[k].key == "diagonal") continue;  // of a box along the axes
      const double unit = before[k].unit == "units" ? scale : 1;
      EXPECT_NEAR(after[k].value, unit * before[k].value, 1e-9 * unit * (1 + std::abs(before[k].value)))
          << before[k].key << " kind " << kind;
    }
  }
}

TEST(CurveFigures, WithConstraintsOnlyTheMovingPart) {
  auto curve = sampled(0, 1, 30, [](double t) { return Vector3(std::cos(t), std::sin(t), 0); });
  std::vector<Vector3> positions = curve.positions();
  positions[25].z() = 0.3;
  curve.set_positions(positions);
  Constraints constraints(curve.node_count());
  for (Index i = 0; i < curve.node_count(); ++i) {
    if (i < 5 || i > 15) constraints.fix_position(i, curve.position(i));
  }
  EXPECT_FALSE(measure_curve(curve, &constraints).normal_error);
  constraints.fix_tangent(4, Vector3(-std::sin(0.13), std::cos(0.13), 0));
  EXPECT_GT(measure_curve(curve).curvature_variation, 10);
  const CurveFigures figures = measure_curve(curve, &constraints);
  EXPECT_LT(figures.curvature_variation, 1e-10);
  ASSERT_TRUE(figures.normal_error);
  const Vector3 p = curve.position(4);
  EXPECT_NEAR(*figures.normal_error, 180 / pi * std::abs(std::atan2(p.y(), p.x()) - 0.13), 1e-9);
  // Against its direction a tangent is as wrong as it can be; a normal has no sense.
  constraints.fix_tangent(4, Vector3(p.y(), -p.x(), 0));
  EXPECT_NEAR(*measure_curve(curve, &constraints).normal_error, 180, 1e-9);
  constraints.free_tangent(4);
  constraints.fix_normal(4, -p);
  EXPECT_NEAR(*measure_curve(curve, &constraints).normal_error, 0, 1e-9);
}

TEST(CurveFigures, HeldNeighboursOfMovingNodesCount) {
  // A kink at the first of two held neighbours, which turns as the moving node before it does.
  const PolygonCurve curve({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {4, 2, 0}, {5, 3, 0}});
  Constraints constraints(6);
  for (const Index i : {0, 2, 3, 4, 5}) constraints.fix_position(i, curve.position(i));
  EXPECT_NEAR(measure(curve, &constraints).greatest_turn, 45, 1e-12);
  constraints.free_position(4);
  // The spring of the edge between both, from curvature at the first to none at the second.
  EXPECT_NEAR(measure(curve, &constraints).vspring_energy, measure(curve).vspring_energy, 1e-12);
}

}  // namespace
}  // namespace vspring::fairness_curve_test
