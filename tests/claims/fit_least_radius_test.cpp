// No sharper bend: what vehicles, tools and roads can turn.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_least_radius_test {
namespace {

using namespace support;

/// Out and back, around a half turn of radius 6, with noise.
std::vector<Vector3> hairpin(double noise) {
  std::vector<Vector3> rows;
  rows.reserve(101);
  for (int k = 0; k < 40; ++k) rows.emplace_back(2 * k, 0, 0);
  for (int k = 0; k <= 20; ++k) {
    const double angle = std::numbers::pi * k / 20;
    rows.emplace_back(80 + 6 * std::sin(angle), 6 - 6 * std::cos(angle), 0);
  }
  for (int k = 39; k >= 0; --k) rows.emplace_back(2 * k, 12, 0);
  const Constraints ends = held_ends(rows);
  return noisy(std::move(rows), ends, noise, 7, true);
}

/// A quarter of a circle of radius 10.
std::vector<Vector3> quarter() {
  std::vector<Vector3> rows;
  rows.reserve(31);
  for (int k = 0; k <= 30; ++k) rows.push_back(10 * heading(std::numbers::pi / 2 * k / 30));
  return rows;
}

FitOptions asked(const FitCriterion& criterion, double radius) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  options.least_radius = radius;
  return options;
}

FitResult drawn(const std::vector<Vector3>& rows, const FitOptions& options) {
  return fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
}

/// Of the circles through three successive nodes.
std::pair<Index, double> sharpest(const std::vector<Vector3>& nodes) {
  const std::vector<double> bent = curvatures(PolygonCurve(nodes));
  const auto most = std::max_element(bent.begin(), bent.end());
  return {static_cast<Index>(most - bent.begin()), 1 / *most};
}

bool warns_of_radius(const FitResult& result) {
  return std::ranges::any_of(result.report.fair.warnings,
                             [](const Warning& warning) { return warning.code == WarningCode::radius_not_kept; });
}

TEST(FitLeastRadius, IsKeptWithinATolerance) {
  const std::vector<Vector3> rows = hairpin(0.8);
  const FitResult free = drawn(rows, asked(Within{1.5}, 0));
  ASSERT_EQ(free.report.fair.outcome, Outcome::converged);
  ASSERT_LT(sharpest(free.positions).second, 6.3);
  EXPECT_FALSE(free.report.least_radius) << "nobody asked";
  const FitResult result = drawn(rows, asked(Within{1.5}, 6.8));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  const auto [node, radius] = sharpest(result.positions);
  EXPECT_GE(radius, 0.99 * 6.8);
  EXPECT_LE(distance(rows, PolygonCurve(result.positions)).greatest, 1.5);
  ASSERT_TRUE(result.report.least_radius);
  EXPECT_NEAR(*result.report.least_radius, radius, 1e-9 * radius);
  EXPECT_EQ(result.report.sharpest_node, node);
}

TEST(FitLeastRadius, IsKeptByNewNodesHoweverClose) {
  const std::vector<Vector3> rows = hairpin(0.8);
  const ResampledFit made =
      fit_resampled(PolygonCurve(rows), held_ends(rows), {.spacing = 0.2}, asked(Within{1.5}, 6.5));
  EXPECT_EQ(made.fit.report.fair.outcome, Outcome::converged);
  EXPECT_GE(sharpest(made.fit.positions).second, 0.99 * 6.5);
}

TEST(FitLeastRadius, IsKeptByEveryCriterion) {
  const std::vector<Vector3> rows = hairpin(0.8);
  for (const FitCriterion& criterion :
       {FitCriterion(RootMeanSquare{0.7}), FitCriterion(Weight{0.01}), FitCriterion(SmoothingLength{3})}) {
    SCOPED_TRACE(criterion.index());
    const double free = sharpest(drawn(rows, asked(criterion, 0)).positions).second;
    const FitResult result = drawn(rows, asked(criterion, 6.5));
    EXPECT_LT(free, 6.4);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_GE(sharpest(result.positions).second, 0.99 * 6.5);
  }
}

TEST(FitLeastRadius, SaysWhereItCannotBeKeptAndStaysWithinTheTolerance) {
  const std::vector<Vector3> rows = hairpin(0.8);
  const FitResult result = drawn(rows, asked(Within{1.2}, 9));
  EXPECT_EQ(result.report.fair.outcome, Outcome::stalled);
  ASSERT_TRUE(warns_of_radius(result));
  const auto [node, radius] = sharpest(result.positions);
  EXPECT_GT(node, 35);
  EXPECT_LT(node, 65);
  EXPECT_LT(radius, 0.99 * 9);
  EXPECT_GT(radius, 6) << "as near to it as the tolerance allows";
  EXPECT_NE(result.report.fair.warnings.back().text.find("at node " + std::to_string(node) + ";"), std::string::npos)
      << result.report.fair.warnings.back().text;
  EXPECT_LE(distance(rows, PolygonCurve(result.positions)).greatest, 1.2);
}

TEST(FitLeastRadius, OfAnArcIsNoLargerThanTheArcAllows) {
  const std::vector<Vector3> rows = quarter();
  for (const auto& [radius, outcome] : {std::pair(9.9, Outcome::converged), std::pair(11.0, Outcome::stalled)}) {
    const FitResult result = drawn(rows, asked(Within{0.01}, radius));
    EXPECT_EQ(result.report.fair.outcome, outcome) << radius;
    EXPECT_EQ(warns_of_radius(result), outcome == Outcome::stalled) << radius;
    // Of the chord and its height, with the ends held.
    EXPECT_NEAR(sharpest(result.positions).second, 10, 0.05) << radius;
  }
}

TEST(FitLeastRadius, GivenDirectionsThatAskForLessAreNamed) {
  std::vector<Vector3> rows = quarter();
  Constraints constraints = held_ends(rows, heading(0), heading(std::numbers::pi));
  const FitResult result = fit(PolygonCurve(rows), constraints, {.positions = rows}, asked(Within{0.05}, 5));
  EXPECT_EQ(result.report.fair.outcome, Outcome::stalled);
  ASSERT_TRUE(warns_of_radius(result));
  EXPECT_TRUE(result.report.sharpest_node < 3 || result.report.sharpest_node > 27) << result.report.sharpest_node;
}

TEST(FitLeastRadius, MustBeANumberAndTheMethodEquilibriums) {
  const std::vector<Vector3> rows = quarter();
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)drawn(rows, asked(Within{0.1}, wrong)), Error) << wrong;
  FitOptions options = asked(Weight{0.01}, 5);
  options.fair.method = SweepMethod{};
  EXPECT_THROW((void)drawn(rows, options), Error);
  options.fair.method = EquilibriumMethod{};
  options.fair.strength = 0.5;
  EXPECT_THROW((void)drawn(rows, options), Error);
}

}  // namespace
}  // namespace vspring::fit_least_radius_test
