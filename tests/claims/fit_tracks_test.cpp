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

double greatest_turn(const std::vector<Vector3>& places) {
  double greatest = 0;
  for (std::size_t k = 1; k + 1 < places.size(); ++k) {
    const Vector3 before = places[k] - places[k - 1];
    const Vector3 after = places[k + 1] - places[k];
    greatest = std::max(greatest, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return greatest;
}

TEST(FitTracks, RowsThatChangedPlacesDoNotFoldTheCurve) {
  Draw draw(8);
  std::vector<Vector3> rows;
  rows.reserve(60);
  for (int k = 0; k < 60; ++k) {
    // A gap after row 32: there the way to where it goes on is a chord.
    const double x = 5 * k + (k > 32 ? 40 : 0);
    rows.emplace_back(x + draw.uniform(-0.1, 0.1), 40 * std::sin(0.02 * x) + draw.uniform(-0.1, 0.1), 0);
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
    EXPECT_GT(greatest_turn(rows), 3);
    EXPECT_LT(greatest_turn(result.positions), 0.3);
  }
}

TEST(FitTracks, AStopAtAHeldEndDoesNotMakeTheRestFollowNoise) {
  Draw draw(9);
  std::vector<Vector3> rows;
  rows.reserve(160);
  for (int k = 0; k < 130; ++k)
    rows.emplace_back(2 * k + draw.uniform(-0.5, 0.5), 30 * std::sin(0.02 * k) + draw.uniform(-0.5, 0.5), 0);
  // Further from each other than from where they truly are.
  for (int k = 0; k < 30; ++k)
    rows.emplace_back(260 + draw.uniform(-0.9, 0.9), 30 * std::sin(2.6) + draw.uniform(-0.9, 0.9), 0);
  FitOptions options{.criterion = Within{1.2}};
  options.fair.distribution = Distribution::keep;
  const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
  const std::vector<Vector3> moving(result.positions.begin(), result.positions.begin() + 120);
  EXPECT_LT(greatest_turn(moving), 0.1);
  EXPECT_LT(distance(std::span(rows).first(120), PolygonCurve(result.positions)).greatest, 1.2);
}

TEST(FitTracks, ReadingsThatAreOffAreLeftOutBeforeAnythingIsPlaced) {
  Track track = tracks()[1];
  std::vector<Vector3> rows = track.rows;
  rows[30].y() += 60;
  rows[90] *= 1000;
  FitOptions options{.criterion = RootMeanSquare{0.3}};
  options.fair.distribution = Distribution::keep;
  options.outliers = 0.03;
  const FitResult result = fit(PolygonCurve(rows), held_ends(rows), {.positions = rows}, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.outliers, 2);
  EXPECT_LT(distance(result.positions, PolygonCurve(track.rows)).greatest, tolerance);
}

}  // namespace
}  // namespace vspring::fit_tracks_test
