// Curves that move in some coordinates only: profiles, offset tables, elevations along a track.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_moving_axes_test {
namespace {

using namespace support;

constexpr std::array<bool, 3> y_alone = {false, true, false};
constexpr std::array<bool, 3> z_alone = {false, false, true};

FitOptions options_for(const FitCriterion& criterion, const std::array<bool, 3>& axes) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  options.moving_axes = axes;
  return options;
}

FitResult fitted(const std::vector<Vector3>& rows, const FitOptions& options) {
  return fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
}

/// Whether rows have kept every coordinate that does not move, to the bit.
void expect_kept(const std::vector<Vector3>& before, const std::vector<Vector3>& after,
                 const std::array<bool, 3>& axes) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axes[static_cast<std::size_t>(axis)]) continue;
      EXPECT_EQ(before[i][axis], after[i][axis]) << "node " << i;
    }
  }
}

double greatest_move(const std::vector<Vector3>& before, const std::vector<Vector3>& after) {
  double greatest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) greatest = std::max(greatest, (after[i] - before[i]).norm());
  return greatest;
}

double rms_apart(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(a.size()));
}

/// Heights over uneven stations, with slopes of up to 1.5; and the same with noise of up to 0.3.
struct Heights {
  std::vector<Vector3> truth;
  std::vector<Vector3> rows;
};

Heights heights() {
  Draw draw(3);
  Heights made;
  double x = 0;
  for (int k = 0; k < 150; ++k) {
    made.truth.emplace_back(x, 30 * std::sin(x / 20), 0);
    made.rows.push_back(made.truth.back() + Vector3(0, draw.uniform(-0.3, 0.3), 0));
    x += draw.uniform(0.5, 2);
  }
  return made;
}

TEST(FitMovingAxes, AProfileKeepsItsStationsAndIsWithinTheToleranceVertically) {
  const Heights profile = heights();
  const FitResult result = fitted(profile.rows, options_for(Within{0.3}, y_alone));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  expect_kept(profile.rows, result.positions, y_alone);
  EXPECT_LE(greatest_move(profile.rows, result.positions), 0.3);
  EXPECT_EQ(result.report.after.all.greatest, greatest_move(profile.rows, result.positions));
  EXPECT_GT(measure_curve(PolygonCurve(profile.rows)).inflections, 40);
  EXPECT_LE(measure_curve(PolygonCurve(result.positions)).inflections, 3);
}

TEST(FitMovingAxes, ARootMeanSquareTakesTheNoiseOffHeights) {
  const Heights profile = heights();
  const double noise = rms_apart(profile.rows, profile.truth);
  for (const FitCriterion& criterion : {FitCriterion(RootMeanSquare{noise}), FitCriterion(SmoothingLength{2.5})}) {
    const FitResult result = fitted(profile.rows, options_for(criterion, y_alone));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    expect_kept(profile.rows, result.positions, y_alone);
    EXPECT_LT(rms_apart(result.positions, profile.truth), noise / 2);
  }
}

TEST(FitMovingAxes, RowsAtOneStationComeOutAsOne) {
  Draw draw(4);
  std::vector<Vector3> rows;
  rows.reserve(120);
  for (int station = 0; station < 40; ++station) {
    for (int n = 0; n < 3; ++n) rows.emplace_back(station, 5 * std::sin(station / 10.0) + draw.uniform(-0.2, 0.2), 0);
  }
  const FitResult result = fit(PolygonCurve(rows), Constraints(static_cast<Index>(rows.size())), {.positions = rows},
                               options_for(Within{0.25}, y_alone));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(greatest_move(rows, result.positions), 0.25);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (rows[k].x() != rows[k - 1].x()) continue;
    EXPECT_EQ(result.positions[k], result.positions[k - 1]);
  }
}

TEST(FitMovingAxes, AVerticalStepStays) {
  Draw draw(4);
  std::vector<Vector3> rows;
  for (int k = 0; k <= 20; ++k) rows.emplace_back(k, draw.uniform(-0.05, 0.05), 0);
  for (int k = 20; k <= 40; ++k) rows.emplace_back(k, 6 + draw.uniform(-0.05, 0.05), 0);
  const FitResult result = fitted(rows, options_for(Within{0.1}, y_alone));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  expect_kept(rows, result.positions, y_alone);
  EXPECT_LE(greatest_move(rows, result.positions), 0.1);
}

TEST(FitMovingAxes, AnAerofoilKeepsItsStationsRoundTheNose) {
  const auto thickness = [](double x) {
    return 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
  };
  for (const double noise : {0.0002, 0.001}) {
    Draw draw(2);
    std::vector<Vector3> rows;
    for (int k = -30; k <= 30; ++k) {
      const double x = 1 - std::cos(0.5 * M_PI * std::abs(k) / 30);
      rows.emplace_back(x, (k < 0 ? 1 : -1) * thickness(x) + (k == -30 || k == 30 ? 0 : draw.uniform(-noise, noise)),
                        0);
    }
    const FitResult result = fitted(rows, options_for(Within{1.2 * noise}, y_alone));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    expect_kept(rows, result.positions, y_alone);
    EXPECT_LE(greatest_move(rows, result.positions), 1.2 * noise);
    EXPECT_LE(measure_curve(PolygonCurve(result.positions)).inflections, 1);
    EXPECT_LE(measure_curve(PolygonCurve(result.positions)).curvature_extrema, 5);
  }
}

TEST(FitMovingAxes, InSpaceTwoCoordinatesMoveOverTheThird) {
  const std::array<bool, 3> y_and_z = {false, true, true};
  Draw draw(6);
  std::vector<Vector3> truth;
  std::vector<Vector3> rows;
  for (int k = 0; k < 120; ++k) {
    const double x = k / 4.0;
    truth.emplace_back(x, 3 * std::sin(x / 10), 0.002 * (x - 15) * (x - 15));
    rows.push_back(truth.back() + Vector3(0, draw.uniform(-0.05, 0.05), draw.uniform(-0.05, 0.05)));
  }
  const FitResult result = fitted(rows, options_for(Within{0.08}, y_and_z));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  expect_kept(rows, result.positions, y_and_z);
  EXPECT_LE(greatest_move(rows, result.positions), 0.08);
  EXPECT_LT(measure_curve(PolygonCurve(result.positions)).greatest_turn,
            0.05 * measure_curve(PolygonCurve(rows)).greatest_turn);
}

/// A way with sharp turns and noise of its own, which is no concern of the heights along it.
Heights heights_along_a_way() {
  Draw draw(7);
  Heights made;
  Vector3 at = Vector3::Zero();
  double way = 0;
  for (int k = 0; k < 200; ++k) {
    made.truth.emplace_back(at.x(), at.y(), 10 * std::sin(way / 60));
    made.rows.push_back(made.truth.back() + Vector3(0, 0, draw.uniform(-0.5, 0.5)));
    const double angle = k / 40 % 2 == 0 ? 0.2 : 2;
    const Vector3 step(std::cos(angle) + draw.uniform(-0.3, 0.3), std::sin(angle) + draw.uniform(-0.3, 0.3), 0);
    at += step;
    way += step.norm();
  }
  return made;
}

TEST(FitMovingAxes, ElevationsAreFairOverTheLengthOfTheWay) {
  const Heights track = heights_along_a_way();
  const double noise = rms_apart(track.rows, track.truth);
  const FitResult result = fitted(track.rows, options_for(RootMeanSquare{noise}, z_alone));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  expect_kept(track.rows, result.positions, z_alone);
  EXPECT_LT(rms_apart(result.positions, track.truth), noise / 3);
}

TEST(FitMovingAxes, NewNodesLieOnTheWay) {
  const Heights track = heights_along_a_way();
  const PolygonCurve curve(track.rows);
  const ResampledFit made =
      fit_resampled(curve, held_ends(track.rows), {.spacing = 0.7}, options_for(Within{0.6}, z_alone));
  std::vector<Vector3> flat = track.rows;
  for (Vector3& row : flat) row.z() = 0;
  std::vector<Vector3> places = made.fit.positions;
  EXPECT_GT(places.size(), 250U);
  EXPECT_EQ(places.front(), track.rows.front());
  EXPECT_EQ(places.back(), track.rows.back());
  for (Vector3& place : places) place.z() = 0;
  EXPECT_LT(distance(places, PolygonCurve(flat)).greatest, 1e-9);
}

TEST(FitMovingAxes, WhatNothingIsToldByIsRefused) {
  const auto refusal = [](const PolygonCurve& curve, const std::vector<Vector3>& points, const FitOptions& options) {
    try {
      (void)fit(curve, Constraints(curve.node_count()), {.positions = points}, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::vector<Vector3> rows = heights().rows;
  std::vector<Vector3> shuffled = rows;
  for (std::size_t k = 0; k + 7 < rows.size(); k += 2) std::swap(shuffled[k], shuffled[k + 7]);
  const FitOptions options = options_for(Within{0.3}, y_alone);
  EXPECT_NE(refusal(PolygonCurve(shuffled), shuffled, options).find("turn back there and"), std::string::npos);
  EXPECT_NE(refusal(PolygonCurve(rows), {{1, 1, 0}}, options).find("the curve's own nodes"), std::string::npos);
  EXPECT_NE(refusal(PolygonCurve(rows), rows, options_for(Within{0.3}, {false, false, false})).find("no coordinate"),
            std::string::npos);
  const std::vector<Vector3> track = heights_along_a_way().rows;
  std::vector<Index> all(track.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Index>(k);
  const PolygonCurve ring(track, {{.nodes = all, .closed = true}});
  EXPECT_NE(refusal(ring, track, options_for(Within{0.3}, z_alone)).find("its chain is closed"), std::string::npos);
}

}  // namespace
}  // namespace vspring::fit_moving_axes_test
