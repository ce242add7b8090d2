// New nodes on the curve that fits the nodes of a table.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_resampled_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;
constexpr Profile naca_2412 = {.camber = 0.02, .camber_at = 0.4, .thickness = 0.12};

/// The profile from tail to tail, by the cosine, its ends exact.
PolygonCurve foil(int nodes, double noise, std::uint64_t seed) {
  std::vector<Vector3> places;
  Draw draw(seed);
  for (int k = 0; k < nodes; ++k) {
    Vector3 off = k == 0 || k + 1 == nodes ? Vector3(Vector3::Zero()) : draw.in_cube(noise);
    off.z() = 0;
    places.emplace_back(on_profile(naca_2412, 2 * pi * k / (nodes - 1)) + off);
  }
  return PolygonCurve(std::move(places));
}

FitOptions within(double tolerance) {
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  options.criterion = Within{tolerance};
  return options;
}

PolygonCurve curve_of(const ResampledFit& made) {
  PolygonCurve curve = made.resampled.curve;
  curve.set_positions(made.fit.positions);
  return curve;
}

struct Case {
  std::string name;
  Resampling how;
};

class FitResampledBy : public testing::TestWithParam<Case> {};

TEST_P(FitResampledBy, ANoisyTableLosesItsNoiseBetweenItsNodesToo) {
  const CurveFigures exact = measure_curve(foil(161, 0, 1));
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    const PolygonCurve table = foil(161, 0.0003, seed);
    const ResampledFit made = fit_resampled(table, held_ends(table.positions()), GetParam().how, within(0.0006));
    EXPECT_EQ(made.fit.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(made.fit.positions.size(), static_cast<std::size_t>(*GetParam().how.nodes));
    EXPECT_LE(distance(table.positions(), curve_of(made)).greatest, 0.0006);
    const CurveFigures after = measure_curve(curve_of(made));
    EXPECT_LE(after.curvature_extrema, exact.curvature_extrema);
    EXPECT_LE(after.inflections, exact.inflections);
    const Resampled plain = resample(table, held_ends(table.positions()), GetParam().how);
    EXPECT_LT(after.curvature_variation, 0.2 * measure_curve(plain.curve).curvature_variation);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FitResampledBy,
                         testing::Values(Case{"cosine", {.nodes = 120, .by = ResamplingBy::cosine}},
                                         Case{"curvature", {.nodes = 120, .by = ResamplingBy::curvature}},
                                         Case{"many", {.nodes = 300, .by = ResamplingBy::curvature}},
                                         Case{"length", {.nodes = 300, .by = ResamplingBy::length}}),
                         [](const auto& one) { return one.param.name; });

TEST(FitResampled, WhereEdgesRiseByMoreThanTheToleranceNodesGoFurtherOut) {
  const PolygonCurve table = foil(161, 0, 1);
  const Constraints held = held_ends(table.positions());
  const Resampling how = {.nodes = 60, .by = ResamplingBy::curvature};
  const double tolerance = distance(table.positions(), resample(table, held, how).curve).greatest;
  const ResampledFit made = fit_resampled(table, held, how, within(tolerance));
  EXPECT_EQ(made.fit.report.fair.outcome, Outcome::converged);
  const PolygonCurve curve = curve_of(made);
  EXPECT_LE(distance(table.positions(), curve).greatest, tolerance);
  EXPECT_LE(distance(curve.positions(), table).greatest, tolerance);
  EXPECT_LE(measure_curve(curve).curvature_extrema, measure_curve(table).curvature_extrema);
}

TEST(FitResampled, TheReportIsAboutTheNewNodes) {
  const PolygonCurve table = foil(81, 0.0003, 4);
  const Constraints held = held_ends(table.positions());
  const Resampling how = {.nodes = 120, .by = ResamplingBy::cosine};
  const ResampledFit made = fit_resampled(table, held, how, within(0.0006));
  const Resampled plain = resample(table, held, how);
  EXPECT_EQ(made.resampled.curve.node_count(), plain.curve.node_count());
  EXPECT_EQ(made.resampled.from, plain.from);
  const FitReport& report = made.fit.report;
  EXPECT_EQ(report.fair.nodes, 120);
  EXPECT_EQ(report.fair.moving_nodes, 118);
  EXPECT_EQ(report.fair.fixed_positions, 2);
  EXPECT_EQ(report.points, 81);
  EXPECT_EQ(report.outside_points, 0);
  EXPECT_GE(report.active_points.size(), 3U);
  EXPECT_EQ(made.fit.distances, point_distances(table.positions(), curve_of(made), Context()));
  EXPECT_EQ(report.after.all.greatest, distance(table.positions(), curve_of(made)).greatest);
  EXPECT_EQ(report.before.all.greatest, 0) << "the points are the table's";
  EXPECT_EQ(report.fair.greatest_move, distance(made.fit.positions, table).greatest);
  EXPECT_LT(measure(curve_of(made), &made.resampled.constraints).vspring_energy,
            measure(plain.curve, &plain.constraints).vspring_energy);
}

TEST(FitResampled, WhatIsHeldStays) {
  const PolygonCurve table = foil(121, 0.0002, 5);
  Constraints held = held_ends(table.positions());
  const Vector3 there = on_profile(naca_2412, pi / 2) + Vector3(0, 0.0001, 0);
  held.fix_position(30, there);
  held.fix_tangent(60, Vector3(0, -1, 0));
  const ResampledFit made = fit_resampled(table, held, {.nodes = 150, .by = ResamplingBy::curvature}, within(0.0005));
  const auto number = [&](Index from) {
    const auto& all = made.resampled.from;
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), from) - all.begin());
  };
  for (const Index end : {0, 120}) EXPECT_EQ(made.fit.positions[number(end)], table.position(end));
  EXPECT_EQ(made.fit.positions[number(30)], there);
  EXPECT_LE(made.fit.report.after.all.greatest, 0.0005);
  const std::vector<Index> nose = {static_cast<Index>(number(60))};
  const std::vector<Vector3> tangents = estimate_tangents(curve_of(made), nose);
  EXPECT_LT(std::abs(tangents[0].x()), 0.05);
}

TEST(FitResampled, ClosedCurvesAreFittedAllAround) {
  std::vector<Vector3> places;
  Draw draw(6);
  for (int k = 0; k < 150; ++k) {
    const double angle = 2 * pi * k / 150;
    const double radius = 1 + 0.1 * std::cos(3 * angle);
    Vector3 off = draw.in_cube(0.003);
    off.z() = 0;
    places.emplace_back(Vector3(radius * std::cos(angle), radius * std::sin(angle), 0) + off);
  }
  const PolygonCurve table(places, true);
  const ResampledFit made = fit_resampled(table, Constraints(150), {.nodes = 90}, within(0.008));
  EXPECT_EQ(made.fit.report.fair.outcome, Outcome::converged);
  EXPECT_TRUE(made.resampled.curve.chains()[0].closed);
  EXPECT_LE(distance(table.positions(), curve_of(made)).greatest, 0.008);
  const CurveFigures after = measure_curve(curve_of(made));
  EXPECT_EQ(after.curvature_extrema, 6);
  EXPECT_LE(after.inflections, 6);
}

TEST(FitResampled, ARootMeanSquareIsUsed) {
  const PolygonCurve table = foil(161, 0.0003, 7);
  FitOptions options = within(1);
  options.criterion = RootMeanSquare{0.0002};
  const ResampledFit made =
      fit_resampled(table, held_ends(table.positions()), {.nodes = 120, .by = ResamplingBy::curvature}, options);
  EXPECT_EQ(made.fit.report.fair.outcome, Outcome::converged);
  EXPECT_LE(made.fit.report.after.all.rms, 0.0002);
  EXPECT_GT(made.fit.report.after.all.rms, 0.00018);
}

TEST(FitResampled, OfTooFewNodesSomeAreSaidToBeOutsideOfAFairShape) {
  const PolygonCurve table = foil(161, 0, 1);
  const ResampledFit made = fit_resampled(table, held_ends(table.positions()), {.nodes = 30}, within(0.0001));
  EXPECT_EQ(made.fit.report.fair.outcome, Outcome::stalled);
  EXPECT_GT(made.fit.report.outside_points, 0);
  EXPECT_FALSE(made.fit.report.fair.warnings.empty());
  const CurveFigures before = measure_curve(made.resampled.curve);
  const CurveFigures after = measure_curve(curve_of(made));
  EXPECT_LE(after.curvature_variation, before.curvature_variation);
  EXPECT_LE(after.curvature_extrema, before.curvature_extrema);
}

TEST(FitResampled, ByAWeightItIsTheFitOfResampledNodes) {
  const PolygonCurve table = foil(81, 0.0003, 8);
  const Constraints held = held_ends(table.positions());
  FitOptions options = within(1);
  options.criterion = Weight{0.01};
  const ResampledFit made = fit_resampled(table, held, {.nodes = 100}, options);
  const Resampled plain = resample(table, held, {.nodes = 100});
  const FitResult fitted = fit(plain.curve, plain.constraints, {.positions = table.positions()}, options);
  EXPECT_EQ(made.fit.positions, fitted.positions);
}

TEST(FitResampled, CancellationEndsWithTheNodesThatWereAskedFor) {
  const PolygonCurve table = foil(161, 0.0003, 9);
  Context context;
  context.on_progress = [&](const Progress&) { context.cancel(); };
  const ResampledFit made = fit_resampled(table, held_ends(table.positions()), {.nodes = 120}, within(0.0006), context);
  EXPECT_EQ(made.fit.report.fair.outcome, Outcome::cancelled);
  EXPECT_EQ(made.fit.positions.size(), 120U);
}

}  // namespace
}  // namespace vspring::fit_resampled_test
