// Corners stay sharp, and sides are fair each for itself.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_corners_test {
namespace {

using namespace support;

/// From one corner to the next with nodes a step apart; the first one again only in what is open.
std::vector<Vector3> along(std::vector<Vector3> corners, double step, bool closed) {
  if (closed) corners.push_back(corners.front());
  std::vector<Vector3> rows;
  for (std::size_t c = 0; c + 1 < corners.size(); ++c) {
    const Vector3 side = corners[c + 1] - corners[c];
    const auto count = static_cast<int>(std::lround(side.norm() / step));
    for (int k = 0; k < count; ++k) rows.emplace_back(corners[c] + side * k / count);
  }
  if (!closed) rows.push_back(corners.back());
  return rows;
}

std::vector<Vector3> box(double step) { return along({{0, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}}, step, true); }

std::vector<Vector3> with_noise(std::vector<Vector3> rows, double noise) {
  const Constraints none(static_cast<Index>(rows.size()));
  return noisy(std::move(rows), none, noise, 11, true);
}

FitOptions asked(const FitCriterion& criterion, double sharp = 40) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  options.sharp = sharp;
  return options;
}

FitResult drawn(const std::vector<Vector3>& rows, bool closed, const FitOptions& options) {
  const Constraints constraints = closed ? Constraints(static_cast<Index>(rows.size())) : held_ends(rows);
  return fit(PolygonCurve(rows, closed), constraints, {.positions = rows}, options);
}

/// The greatest distance of nodes from the straight line between the corners to either side of them.
double greatest_bow(const std::vector<Vector3>& nodes, const std::vector<Index>& corners) {
  double greatest = 0;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const auto count = static_cast<Index>(nodes.size());
    const Index last = corners[(c + 1) % corners.size()];
    const Vector3& from = nodes[static_cast<std::size_t>(corners[c])];
    const Vector3 side = (nodes[static_cast<std::size_t>(last)] - from).normalized();
    for (Index k = corners[c]; k != last; k = (k + 1) % count) {
      const Vector3 way = nodes[static_cast<std::size_t>(k)] - from;
      greatest = std::max(greatest, (way - way.dot(side) * side).norm());
    }
  }
  return greatest;
}

TEST(FitCorners, ABoxInNoiseHasFourAndStraightSides) {
  for (const double step : {0.5, 1.0, 3.0}) {
    SCOPED_TRACE(step);
    const std::vector<Vector3> rows = with_noise(box(step), 0.5);
    const FitResult result = drawn(rows, true, asked(Within{1}));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(result.report.fair.corners, 4);
    const PolygonCurve fitted(result.positions, true);
    const std::vector<Index> corners = find_corners(fitted, 60);
    ASSERT_EQ(corners.size(), 4U);
    EXPECT_EQ(find_corners(fitted, 2), corners) << "and nothing else turns";
    EXPECT_LT(greatest_bow(result.positions, corners), 0.05);
    for (const Index corner : corners) {
      const Vector3& place = result.positions[static_cast<std::size_t>(corner)];
      EXPECT_LT(std::hypot(std::min(std::abs(place.x()), std::abs(place.x() - 40)),
                           std::min(std::abs(place.y()), std::abs(place.y() - 30))),
                0.75);
    }
    EXPECT_LE(distance(rows, fitted).greatest, 1);
    // Without them they are rounded off.
    EXPECT_EQ(find_corners(PolygonCurve(drawn(rows, true, asked(Within{1}, 0)).positions, true), 60).size(), 0U);
  }
}

TEST(FitCorners, AreKeptByEveryCriterionAndByNewNodes) {
  const std::vector<Vector3> rows = with_noise(box(1), 0.5);
  for (const FitCriterion& criterion :
       {FitCriterion(RootMeanSquare{0.3}), FitCriterion(Weight{0.001}), FitCriterion(SmoothingLength{4})}) {
    SCOPED_TRACE(criterion.index());
    const FitResult result = drawn(rows, true, asked(criterion));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(find_corners(PolygonCurve(result.positions, true), 60).size(), 4U);
  }
  for (const Resampling& how : {Resampling{.nodes = 20}, Resampling{.spacing = 0.3}}) {
    const ResampledFit made =
        fit_resampled(PolygonCurve(rows, true), Constraints(static_cast<Index>(rows.size())), how, asked(Within{1}));
    EXPECT_EQ(made.fit.report.fair.corners, 4);
    EXPECT_EQ(find_corners(made.resampled.curve, 60).size(), 4U);
    EXPECT_EQ(find_corners(made.resampled.curve, 5).size(), 4U);
  }
}

TEST(FitCorners, HaveNoRadius) {
  const std::vector<Vector3> rows = with_noise(box(1), 0.5);
  FitOptions options = asked(Within{1});
  options.least_radius = 100;
  const FitResult result = drawn(rows, true, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.corners, 4);
}

TEST(FitCorners, AreNotMadeWhereTheWayIsSmooth) {
  std::vector<Vector3> wave;
  wave.reserve(200);
  for (int k = 0; k < 200; ++k) wave.emplace_back(0.5 * k, 15 * std::sin(0.05 * k), 0);
  const FitOptions options = asked(Within{1});
  EXPECT_EQ(drawn(with_noise(wave, 0.4), false, options).report.fair.corners, 0);
  EXPECT_EQ(drawn(with_noise(wave, 0.4), false, options).positions,
            drawn(with_noise(wave, 0.4), false, asked(Within{1}, 0)).positions);
}

TEST(FitCorners, OfACuspTurnBackAndSidesStayCurved) {
  std::vector<Vector3> rows;
  rows.reserve(101);
  for (int k = -50; k <= 50; ++k) rows.emplace_back(50 - std::abs(k), (k < 0 ? 0.01 : -0.01) * k * k, 0);
  rows = with_noise(std::move(rows), 0.4);
  const FitResult result = drawn(rows, false, asked(Within{1}));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.corners, 1);
  const PolygonCurve fitted(result.positions);
  ASSERT_EQ(find_corners(fitted, 150).size(), 1U);
  EXPECT_EQ(find_corners(fitted, 5).size(), 1U);
  EXPECT_GT((result.positions[20] - (result.positions[0] + result.positions[45]) / 2).norm(), 1) << "no straight line";
}

TEST(FitCorners, AloneOnAClosedCurveKeepNodesBesideThemApart) {
  std::vector<Vector3> drop;
  drop.reserve(80);
  for (int k = 0; k < 80; ++k) {
    const double angle = 2 * std::numbers::pi * k / 80;
    drop.emplace_back(10 * (1 - std::cos(angle)), 6 * std::sin(angle) * std::sin(angle / 2), 0);
  }
  drop = with_noise(std::move(drop), 0.04);
  const FitResult result = drawn(drop, true, asked(Within{0.1}, 50));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.corners, 1);
  EXPECT_LT(result.report.greatest_slide, 0.2);
}

TEST(FitCorners, MayBeEveryNodeAndGivenByNumber) {
  const std::vector<Vector3> square = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  const FitResult result = drawn(square, true, asked(Within{0.1}));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.corners, 4);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((result.positions[k] - square[k]).norm(), 0.1);
  const std::vector<Vector3> bend = with_noise(along({{0, 0, 0}, {30, 0, 0}, {55, 15, 0}}, 1, false), 0.5);
  FitOptions options = asked(Within{1}, 0);
  options.fair.corners = {30};
  const FitResult given = drawn(bend, false, options);
  EXPECT_EQ(given.report.fair.corners, 1);
  EXPECT_EQ(find_corners(PolygonCurve(given.positions), 20), std::vector<Index>{30});
}

TEST(FitCorners, StayWherePlainFairingFindsThem) {
  std::vector<Vector3> rows = along({{0, 0, 0}, {40, 0, 0}, {40, 30, 0}}, 1, false);
  const Vector3 corner = rows[40];
  Draw draw(2);
  for (Vector3& row : rows) row.z() = draw.uniform(-0.1, 0.1);
  rows[40] = corner;
  FairOptions options;
  options.corners = find_corners(PolygonCurve(rows), 60);
  ASSERT_EQ(options.corners, std::vector<Index>{40});
  const FairResult result = fair(PolygonCurve(rows), held_ends(rows), options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.corners, 1);
  EXPECT_EQ(result.positions[40], corner);
  EXPECT_EQ(find_corners(PolygonCurve(result.positions), 0.1), std::vector<Index>{40}) << "both sides are straight";
  // With a direction given there is one.
  Constraints held = held_ends(rows);
  held.fix_tangent(40, Vector3(1, 1, 0).normalized());
  EXPECT_EQ(fair(PolygonCurve(rows), held, options).report.corners, 0);
}

TEST(FitCorners, OfAPolygonLeaveNothingToMove) {
  const std::vector<Vector3> square = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  FairOptions options;
  options.corners = {0, 1, 2, 3};
  const FairResult result = fair(PolygonCurve(square, true), Constraints(4), options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.positions, square);
}

TEST(FitCorners, AreKeptByResamplingWithADirectionOnEitherSide) {
  std::vector<Vector3> rows;
  rows.reserve(31);
  for (int k = 0; k <= 20; ++k) rows.push_back(10 * heading(std::numbers::pi * (1 - k / 20.0)));
  for (int k = 1; k <= 10; ++k) rows.emplace_back(10 + k, 0, 0);
  const Resampled made = resample(PolygonCurve(rows), held_ends(rows), {.nodes = 101, .corners = {20}});
  const auto corner = std::find(made.from.begin(), made.from.end(), 20);
  ASSERT_NE(corner, made.from.end());
  const auto first = corner - made.from.begin();
  for (Index k = 0; k < made.curve.node_count(); ++k) {
    const Vector3& place = made.curve.position(k);
    if (k > first)
      EXPECT_NEAR(place.y(), 0, 1e-12) << k;
    else
      EXPECT_NEAR(place.norm(), 10, 2e-3) << k;
  }
}

TEST(FitCorners, WrongOnesAreRefused) {
  const std::vector<Vector3> rows = box(5);
  for (const double wrong : {-1.0, 180.0, std::nan("")})
    EXPECT_THROW((void)drawn(rows, true, asked(Within{1}, wrong)), Error) << wrong;
  for (const Index wrong : {-1, 28}) {
    FairOptions options;
    options.corners = {wrong};
    EXPECT_THROW((void)fair(PolygonCurve(rows, true), Constraints(28), options), Error) << wrong;
    FitOptions fitting = asked(Within{1}, 0);
    fitting.fair.corners = {wrong};
    EXPECT_THROW((void)drawn(rows, true, fitting), Error) << wrong;
    EXPECT_THROW((void)resample(PolygonCurve(rows, true), Constraints(28), {.nodes = 40, .corners = {wrong}}), Error);
  }
  FitOptions options = asked(Weight{0.01});
  options.fair.method = SweepMethod{};
  EXPECT_THROW((void)drawn(rows, true, options), Error);
}

}  // namespace
}  // namespace vspring::fit_corners_test
