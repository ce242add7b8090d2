// What people log: stops, steps back, doubled rows, sharp turns, the same way back, readings that are off.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_tracks_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;
constexpr double tolerance = 1.5;

/// A row every 5 along a wave, up to so far off in x and y.
std::vector<Vector3> noisy_wave(std::uint64_t seed, int count, double noise) {
  Draw draw(seed);
  std::vector<Vector3> rows;
  rows.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    rows.emplace_back(5 * k + draw.uniform(-noise, noise), 30 * std::sin(0.1 * k) + draw.uniform(-noise, noise), 0);
  return rows;
}

struct Track {
  std::string name;
  std::vector<Vector3> rows;
};

std::vector<Track> tracks() {
  Draw draw(5);
  const auto log = [&](double x, double y) {
    return Vector3(x + draw.uniform(-0.5, 0.5), y + draw.uniform(-0.5, 0.5), 0);
  };
  std::vector<Vector3> wave;
  wave.reserve(120);
  for (int k = 0; k < 120; ++k) wave.push_back(log(2 * k, 30 * std::sin(0.05 * k)));
  Track stop{"stop", wave};
  for (int n = 0; n < 30; ++n) stop.rows.insert(stop.rows.begin() + 60, log(120, 30 * std::sin(3.0)));
  Track fold{"steps back", wave};
  std::swap(fold.rows[50], fold.rows[52]);
  Track doubled{"doubled rows", wave};
  for (const int k : {80, 40, 40})
    doubled.rows.insert(doubled.rows.begin() + k, doubled.rows[static_cast<std::size_t>(k)]);
  Track turn{"sharp turn", {}};
  turn.rows.reserve(79);
  for (int k = 0; k < 40; ++k) turn.rows.push_back(log(5 * k, 0));
  for (int k = 1; k < 40; ++k) turn.rows.push_back(log(195 - 3.5 * k, 3.5 * k));
  Track back{"out and back", {}};
  back.rows.reserve(119);
  for (int k = 0; k < 60; ++k) back.rows.push_back(log(5 * k, 20 * std::sin(0.05 * k)));
  for (int k = 58; k >= 0; --k) back.rows.push_back(log(5 * k, 20 * std::sin(0.05 * k)));
  return {stop, fold, doubled, turn, back};
}

TEST(FitTracks, AreFinishedAndNearBothWays) {
  for (const Track& track : tracks()) {
    SCOPED_TRACE(track.name);
    const PolygonCurve curve(track.rows);
    FitOptions options{.criterion = Within{tolerance}};
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(curve, held_ends(track.rows), {.positions = track.rows}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    const PolygonCurve fitted(result.positions);
    EXPECT_LE(distance(track.rows, fitted).greatest, tolerance);
    // Where it turns round to go back the same way, places are nearest to another piece of the polyline from step to
    // step: there the curve's own bound is kept to a twentieth.
    const double most = (track.name == "out and back" ? 1.05 : 1.001) * tolerance;
    EXPECT_LE(distance(result.positions, curve).greatest, most);
    EXPECT_LE(result.report.shape.greatest, most);
    EXPECT_GT(measure_curve(fitted).curvature_variation, 0);
    EXPECT_LT(measure_curve(fitted).inflections, measure_curve(curve).inflections / 4);
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < result.positions.size(); ++k)
      shortest = std::min(shortest, (result.positions[k] - result.positions[k - 1]).norm());
    EXPECT_GT(shortest, 0) << "no node vanishes";
  }
}

TEST(FitTracks, RowsThatAreAllThereTwiceAreDrawnLikeThoseThatAreThereOnce) {
  const std::vector<Vector3> rows = noisy_wave(7, 100, 0.5);
  std::vector<Vector3> doubled;
  for (const Vector3& row : rows) doubled.insert(doubled.end(), 2, row);
  EXPECT_DOUBLE_EQ(measure(PolygonCurve(doubled)).greatest_turn, measure(PolygonCurve(rows)).greatest_turn);
  EXPECT_DOUBLE_EQ(measure(PolygonCurve(doubled)).vspring_energy, measure(PolygonCurve(rows)).vspring_energy);
  EXPECT_DOUBLE_EQ(estimate_noise(PolygonCurve(doubled)).deviation, estimate_noise(PolygonCurve(rows)).deviation);
  for (const FitCriterion& criterion : {FitCriterion(Within{1.5}), FitCriterion(RootMeanSquare{0.4})}) {
    FitOptions options{.criterion = criterion};
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(PolygonCurve(doubled), held_ends(doubled), {.positions = doubled}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LT(measure(PolygonCurve(result.positions)).greatest_turn, 10);
    EXPECT_GT(measure(PolygonCurve(doubled)).greatest_turn, 15);
  }
}

TEST(FitTracks, FreeEndsAreWhereTheRowsEnd) {
  Draw draw(12);
  for (int turn = 0; turn < 10; ++turn) {
    SCOPED_TRACE(turn);
    // A waterline with stations by the cosine: the first rows are nearer to each other than their noise.
    std::vector<Vector3> rows;
    rows.reserve(21);
    for (int k = 0; k <= 20; ++k) {
      const double t = pi * (1 - std::cos(pi * k / 20)) / 2;
      rows.emplace_back(20 * t + draw.uniform(-0.02, 0.02), 4 * std::sin(t) + draw.uniform(-0.02, 0.02), 0);
    }
    for (const FitCriterion& criterion : {FitCriterion(Within{0.03}), FitCriterion(RootMeanSquare{0.012})}) {
      FitOptions options{.criterion = criterion};
      options.fair.distribution = Distribution::keep;
      const FitResult result = fit(PolygonCurve(rows), Constraints(21), {.positions = rows}, options);
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_NE(result.positions, rows) << "handed back";
      EXPECT_LT((result.positions.front() - rows.front()).norm(), 0.1);
      EXPECT_LT((result.positions.back() - rows.back()).norm(), 0.1);
    }
  }
}

TEST(FitTracks, TurnsOfAnyAngleAreWithinBothWays) {
  Draw draw(13);
  for (const double degrees : {60.0, 90.0, 120.0, 150.0, 179.0}) {
    SCOPED_TRACE(degrees);
    const double angle = degrees / 180 * pi;
    std::vector<Vector3> rows;
    const auto log = [&](double x, double y) {
      rows.emplace_back(x + draw.uniform(-0.8, 0.8), y + draw.uniform(-0.8, 0.8), 0);
    };
    for (int k = 0; k <= 30; ++k) log(5 * k, 0);
    for (int k = 1; k <= 30; ++k) log(150 + 5 * k * std::cos(angle), 5 * k * std::sin(angle));
    FitOptions options{.criterion = Within{tolerance}};
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LE(distance(rows, PolygonCurve(result.positions)).greatest, tolerance);
    EXPECT_LE(result.report.shape.greatest, 1.001 * tolerance);
  }
}

TEST(FitTracks, AReadingThatIsFarOffCostsBoundedWorkAndIsNamed) {
  std::vector<Vector3> rows = noisy_wave(11, 60, 0.8);
  rows[15].y() += 400;
  FitOptions options{.criterion = Within{tolerance}};
  options.fair.distribution = Distribution::keep;
  const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
  // Of some 3,500 nodes; without a bound it was 90 and more.
  EXPECT_LT(result.report.fair.iterations, 40);
  const auto& warnings = result.report.fair.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
    return warning.code == WarningCode::outliers_left && warning.text.find("point 15 ") != std::string::npos;
  }));
  options.outliers = 0.02;
  const FitResult without = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
  EXPECT_EQ(without.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(without.report.outlying_points, std::vector<Index>{15});
  EXPECT_LT(without.report.greatest_slide, 10) << "of those that count";
}

TEST(FitTracks, RowsThatChangedPlacesDoNotFoldTheCurve) {
  Draw draw(8);
  std::vector<Vector3> rows;
  rows.reserve(60);
  for (int k = 0; k < 60; ++k) {
    // A gap after row 32: there the way to where it goes on is a chord.
    const double x = 5 * k + (k > 32 ? 40 : 0);
    Vector3 off = draw.in_cube(0.1);
    off.z() = 0;
    rows.emplace_back(Vector3(x, 40 * std::sin(0.02 * x), 0) + off);
  }
  std::swap(rows[12], rows[14]);
  std::swap(rows[13], rows[15]);
  std::swap(rows[30], rows[32]);
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  for (const FitCriterion& criterion : {FitCriterion(Within{0.3}), FitCriterion(RootMeanSquare{0.1})}) {
    options.criterion = criterion;
    const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_GT(measure(PolygonCurve(rows)).greatest_turn, 170);
    EXPECT_LT(measure(PolygonCurve(result.positions)).greatest_turn, 15);
  }
}

TEST(FitTracks, AStopAtAHeldEndDoesNotMakeTheRestFollowNoise) {
  Draw draw(9);
  std::vector<Vector3> rows;
  rows.reserve(160);
  const auto log = [&](double k, double noise) {
    Vector3 off = draw.in_cube(noise);
    off.z() = 0;
    rows.emplace_back(Vector3(2 * k, 30 * std::sin(0.02 * k), 0) + off);
  };
  for (int k = 0; k < 130; ++k) log(k, 0.5);
  // Further from each other than from where they truly are.
  for (int k = 0; k < 30; ++k) log(130, 0.9);
  FitOptions options{.criterion = Within{1.2}};
  options.fair.distribution = Distribution::keep;
  const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
  const std::vector<Vector3> moving(result.positions.begin(), result.positions.begin() + 120);
  EXPECT_LT(measure(PolygonCurve(moving)).greatest_turn, 5);
  EXPECT_LT(distance(std::span(rows).first(120), PolygonCurve(result.positions)).greatest, 1.2);
}

TEST(FitTracks, RowsThatNoFairCurveGoesAlongAreWithinAllTheSame) {
  Draw draw(11);
  for (int drawn = 0; drawn < 3; ++drawn) {
    SCOPED_TRACE(drawn);
    std::vector<Vector3> rows;
    rows.reserve(60);
    for (int k = 0; k < 60; ++k) {
      Vector3 step = draw.in_cube(5);
      step.z() = 0;
      rows.push_back(k == 0 ? step : Vector3(rows.back() + step));
    }
    FitOptions options{.criterion = Within{1}};
    options.fair.distribution = Distribution::keep;
    const PolygonCurve curve(rows, true);
    const FitResult result = fit(curve, Constraints(60), {.positions = rows}, options);
    EXPECT_LE(*std::max_element(result.distances.begin(), result.distances.end()), 1);
    const PolygonCurve shape(result.positions, true);
    EXPECT_LE(measure_curve(shape).curvature_variation, measure_curve(curve).curvature_variation);
  }
}

/// Of all edges, in radians.
double turning(const std::vector<Vector3>& places) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < places.size(); ++k) {
    const Vector3 before = places[k] - places[k - 1];
    const Vector3 after = places[k + 1] - places[k];
    sum += std::atan2(before.cross(after).norm(), before.dot(after));
  }
  return sum;
}

// Of a track with sharp turns, noise of 1.4 median edges.
constexpr double turning_rows[][2] = {
    {0.23, -0.22}, {0.56, -0.32}, {0.6, 0.18},   {0.69, -0.09}, {0.7, 0.24},   {1.44, 0.05},  {1.28, -0.01},
    {1.7, 0.1},    {1.7, 0.4},    {1.51, 0.06},  {2.18, -0.1},  {1.85, -0.26}, {2.26, -0.29}, {2.85, -0.26},
    {3.05, 0.18},  {3.01, -0.49}, {3.22, -0.36}, {3.3, -0.24},  {4, -0.07},    {3.81, -0.33}, {3.92, -0.35},
    {3.88, -0.54}, {3.75, -0.4},  {3.87, -1.06}, {4.24, -1.13}, {4.77, -1.24}, {4.57, -1.27}, {4.12, -1.8},
    {4.18, -1.5},  {4.2, -1.81},  {4.67, -1.6},  {4.8, -2.06},  {4.84, -2.34}, {4.8, -2.13},  {4.74, -2.48},
    {5.09, -2.48}, {5.13, -2.44}, {5.18, -2.67}, {4.86, -2.94}, {5.42, -3.1},  {5.59, -3.71}, {5.57, -3.3},
    {5.48, -3.37}, {5.52, -3.58}, {5.64, -4.05}, {5.64, -3.61}, {5.66, -4.13}, {5.66, -4.81}, {6.32, -4.61},
    {5.78, -4.47}, {6.12, -4.49}, {6.11, -4.77}, {5.7, -4.63},  {6.33, -4.68}, {6.3, -4.74},  {6.16, -5.33},
    {6.38, -4.8},  {6.02, -5.29}, {6.36, -5.21}, {6.17, -4.68}, {6.45, -4.62}, {5.7, -4.72},  {6.05, -4.05},
    {5.09, -4.01}, {5.45, -3.75}, {5.44, -3.58}, {5.34, -3.63}, {4.77, -3.55}, {4.6, -2.72}};

TEST(FitTracks, BetweenPointsThatAreNearEachOtherTheCurveDoesNotGoFar) {
  std::vector<Vector3> rows;
  rows.reserve(std::size(turning_rows));
  for (const auto& row : turning_rows) rows.emplace_back(row[0], row[1], 0);
  FitOptions options{.criterion = Within{0.6004}};
  options.fair.distribution = Distribution::keep;
  const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.shape.greatest, 1.01 * 0.6004);
  EXPECT_LT(measure_curve(PolygonCurve(result.positions)).length, measure_curve(PolygonCurve(rows)).length);
}

TEST(FitTracks, RowsOfAStopAboutAHeldEndLeaveTheCurveFair) {
  Draw draw(22);
  std::vector<Vector3> rows;
  for (int k = 0; k < 160; ++k) {
    Vector3 noise = draw.in_cube(0.013);
    noise.z() = 0;
    const double at = std::min(k, 119) / 40.0;
    rows.emplace_back(Vector3(at, std::sin(at), 0) + noise);
  }
  // The end is held where noise has taken it.
  rows.back() += Vector3(0.002, 0.008, 0);
  const PolygonCurve curve(rows, false);
  Constraints held(curve.node_count());
  fix_boundary_positions(held, curve);
  FitOptions options{.criterion = Within{0.015}};
  options.fair.distribution = Distribution::keep;
  const FitResult result = fit(curve, held, {.positions = rows}, options);
  EXPECT_NE(result.positions, rows);
  EXPECT_LT(turning(result.positions), 0.1 * turning(rows));
}

TEST(FitTracks, RowsOutOfOrderAcrossABendAreDrawnInTheirOrder) {
  Draw draw(3);
  for (int drawn = 0; drawn < 5; ++drawn) {
    SCOPED_TRACE(drawn);
    std::vector<Vector3> rows;
    double at = 0;
    while (at < 60) {
      Vector3 off = draw.in_cube(0.02);
      off.z() = 0;
      rows.emplace_back(Vector3(10 * std::cos(at / 10), 10 * std::sin(at / 10), 0) + off);
      at += draw.uniform(2, 5);
    }
    std::swap(rows[5], rows[7]);
    FitOptions options{.criterion = Within{0.06}};
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_NEAR(turning(result.positions), 6, 1);
  }
}

TEST(FitTracks, OutAndBackAsFarAsARootMeanSquareAllowsTheTipDoesNotTakeInNoise) {
  Draw draw(5);
  for (int drawn = 0; drawn < 8; ++drawn) {
    SCOPED_TRACE(drawn);
    std::vector<Vector3> rows;
    rows.reserve(119);
    for (int k = 0; k < 119; ++k) {
      const double at = 2 * std::min(k, 118 - k);
      Vector3 off = draw.in_cube(0.104);
      off.z() = 0;
      rows.emplace_back(Vector3(at, 8 * std::sin(at / 20), 0) + off);
    }
    FitOptions options{.criterion = RootMeanSquare{0.06}};
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_GT(result.report.after.all.rms, 0.6 * 0.06);
    EXPECT_LT(turning(result.positions), 7.5);
  }
}

TEST(FitTracks, ReadingsThatAreOffAreLeftOutBeforeAnythingIsPlaced) {
  Track track = tracks()[1];
  std::vector<Vector3> rows = track.rows;
  rows[30].y() += 60;
  rows[90] *= 1000;
  for (const FitCriterion& criterion : {FitCriterion(RootMeanSquare{0.3}), FitCriterion(SmoothingLength{4})}) {
    FitOptions options{.criterion = criterion};
    options.fair.distribution = Distribution::keep;
    options.outliers = 0.03;
    const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(result.report.outliers, 2);
    EXPECT_LT(distance(result.positions, PolygonCurve(track.rows)).greatest, tolerance);
  }
}

}  // namespace
}  // namespace vspring::fit_tracks_test
