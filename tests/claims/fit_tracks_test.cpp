// What people log: stops, steps back, doubled rows, sharp turns, the same way back, readings that are off.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_tracks_test {
namespace {

using namespace support;

constexpr double tolerance = 1.5;

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
