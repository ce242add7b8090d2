// Noise taken off curves, by what it leaves and not by a tolerance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_curve_noise_test {
namespace {

using namespace support;

struct Noisy {
  std::string name;
  std::vector<Vector3> truth;
  std::vector<Vector3> rows;
  double deviation;  ///< of the rows, in each coordinate
};

// Twelve numbers of unit variance less six: nearly normal.
double normal(Draw& draw) {
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += draw.uniform(0, 1);
  return sum - 6;
}

/// Noise of half an edge, about, and of two.
std::vector<Noisy> noisy_curves() {
  std::vector<Noisy> made;
  Draw draw(11);
  for (const double deviation : {0.02, 0.08}) {
    for (const bool in_space : {false, true}) {
      Noisy curve{in_space ? "helix" : "wave", {}, {}, deviation};
      for (int k = 0; k < 240; ++k) {
        const double at = k / 24.0;
        curve.truth.push_back(in_space ? Vector3(std::cos(at), std::sin(at), 0.3 * at) : Vector3(at, std::sin(at), 0));
        Vector3 off(normal(draw), normal(draw), normal(draw));
        if (!in_space) off.z() = 0;
        curve.rows.push_back(curve.truth.back() + deviation * off);
      }
      made.push_back(curve);
    }
  }
  return made;
}

/// A wave in steps of 0.04.
std::vector<Vector3> dense_wave() {
  std::vector<Vector3> places;
  places.reserve(250);
  for (int k = 0; k < 250; ++k) places.emplace_back(0.04 * k, std::sin(0.04 * k), 0);
  return places;
}

std::vector<Vector3> with_noise(std::vector<Vector3> places, double deviation, std::uint64_t seed) {
  Draw draw(seed);
  for (Vector3& place : places) {
    place.x() += deviation * normal(draw);
    place.y() += deviation * normal(draw);
  }
  return places;
}

FitResult fitted(const std::vector<Vector3>& rows, const FitCriterion& criterion) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  return fit(PolygonCurve(rows), Constraints(static_cast<Index>(rows.size())), {.positions = rows}, options);
}

double rms_from(const std::vector<Vector3>& truth, const std::vector<Vector3>& nodes) {
  return distance(nodes, PolygonCurve(truth)).rms;
}

TEST(FitCurveNoise, WhatIsLeftIsNearTheTruthWhateverTheEstimate) {
  for (const Noisy& curve : noisy_curves()) {
    for (const double share : {0.85, 1.0, 1.2}) {
      SCOPED_TRACE(curve.name + " " + std::to_string(curve.deviation) + " " + std::to_string(share));
      const FitResult result = fitted(curve.rows, Noise{share * curve.deviation});
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_LT(rms_from(curve.truth, result.positions), 0.45 * rms_from(curve.truth, curve.rows));
      ASSERT_TRUE(result.report.noise_leaves);
      EXPECT_NEAR(result.report.after.all.rms, *result.report.noise_leaves, 0.03 * *result.report.noise_leaves);
      // No more than noise of that deviation leaves of the rows, and not much less.
      const double across = curve.deviation * (curve.name == "helix" ? std::numbers::sqrt2 : 1);
      EXPECT_NEAR(*result.report.noise_leaves, across, 0.15 * across);
    }
  }
}

TEST(FitCurveNoise, IsFollowedLessThanByARootMeanSquareThatIsTooSmall) {
  const auto extremes = [](const Noisy& curve, const FitCriterion& criterion) {
    const PolygonCurve rows(curve.rows);
    const ResampledFit made =
        fit_resampled(rows, Constraints(rows.node_count()), {.nodes = 80}, {.criterion = criterion});
    return measure_curve(made.resampled.curve).curvature_extrema;
  };
  double by_noise = 0;
  double by_rms = 0;
  for (const Noisy& curve : noisy_curves()) {
    const double low = 0.85 * curve.deviation;
    by_noise += extremes(curve, Noise{low});
    by_rms += extremes(curve, RootMeanSquare{low * (curve.name == "helix" ? std::numbers::sqrt2 : 1)});
  }
  EXPECT_LT(by_noise, by_rms / 3);
}

/// The greatest turn from one edge to the next, in degrees, edges without length left out.
double greatest_turn(const std::vector<Vector3>& nodes) {
  double least = 1;
  Vector3 last = Vector3::Zero();
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Vector3 edge = nodes[i] - nodes[i - 1];
    if (edge.norm() < 1e-9) continue;
    if (!last.isZero(0)) least = std::min(least, last.normalized().dot(edge.normalized()));
    last = edge;
  }
  return std::acos(least) * 180 / std::numbers::pi;
}

/// Rows of a receiver that moves slowly: noise of eight steps.
TEST(FitCurveNoise, OfRowsMuchDenserThanItLeavesNoFoldsAndAccusesNone) {
  constexpr double deviation = 0.32;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Vector3> truth = dense_wave();
    const std::vector<Vector3> rows = with_noise(truth, deviation, seed);
    Constraints ends(static_cast<Index>(rows.size()));
    for (const std::size_t i : {std::size_t{0}, rows.size() - 1}) ends.fix_position(static_cast<Index>(i), rows[i]);
    FitOptions options{.criterion = Noise{deviation}};
    const FitResult result = fit(PolygonCurve(rows), ends, {.positions = rows}, options);
    EXPECT_TRUE(result.report.fair.usable());
    EXPECT_LT(greatest_turn(result.positions), 60);
    EXPECT_TRUE(result.report.fair.warnings.empty());
    EXPECT_LT(rms_from(truth, result.positions), 0.45 * deviation);
  }
}

TEST(FitCurveNoise, GoesWithNewNodesAndWithHeightsAlone) {
  const Noisy curve = noisy_curves().front();
  const PolygonCurve rows(curve.rows);
  const Constraints free(rows.node_count());
  const ResampledFit made = fit_resampled(rows, free, {.nodes = 60}, {.criterion = Noise{curve.deviation}});
  EXPECT_EQ(made.fit.positions.size(), 60U);
  EXPECT_LT(rms_from(curve.truth, made.fit.positions), 0.5 * curve.deviation);
  std::vector<Vector3> heights = curve.truth;
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i].y() = curve.rows[i].y();
  FitOptions options{.criterion = Noise{curve.deviation}};
  options.moving_axes = {false, true, false};
  const FitResult result = fit(PolygonCurve(heights), free, {.positions = heights}, options);
  double squares = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) squares += (result.positions[i] - curve.truth[i]).squaredNorm();
  EXPECT_LT(std::sqrt(squares / static_cast<double>(heights.size())), 0.4 * curve.deviation);
}

TEST(FitCurveNoise, OfTheRimsOfATubeLeavesCircles) {
  // Many circles are within the tolerance, and all are as fair.
  constexpr int count = 16;
  constexpr double deviation = 0.2 * 2 * std::numbers::pi / count;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Draw draw(seed);
    std::vector<Vector3> rows;
    std::vector<PolygonCurve::Chain> chains;
    for (const double height : {0.0, 4.0}) {
      PolygonCurve::Chain& chain = chains.emplace_back();
      chain.closed = true;
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        chain.nodes.push_back(static_cast<Index>(rows.size()));
        const Vector3 off(normal(draw), normal(draw), normal(draw));
        rows.push_back(Vector3(std::cos(angle), std::sin(angle), height) + deviation * off);
      }
    }
    const PolygonCurve curve(rows, chains);
    const FitResult result =
        fit(curve, Constraints(curve.node_count()), {.positions = rows}, {.criterion = Within{3.44 * deviation}});
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << seed;
    EXPECT_LE(result.report.after.all.greatest, 3.44 * deviation);
  }
}

}  // namespace
}  // namespace vspring::fit_curve_noise_test
