// Curves fitted to their own nodes within a tolerance, nodes keeping their places.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_own_nodes_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

FitResult fit_within(const PolygonCurve& curve, const Constraints& held, double tolerance) {
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  options.criterion = Within{tolerance};
  return fit(curve, held, {.positions = curve.positions()}, options);
}

/// Of so many nodes, edges of which are eight times as long where they are not about the nose, rounded to 5 decimals.
std::vector<Vector3> foil(const Profile& profile, int nodes) {
  constexpr int fine = 8000;
  std::vector<double> along = {0};
  for (int k = 1; k <= fine; ++k) {
    const double step = (on_profile(profile, 2 * pi * k / fine) - on_profile(profile, 2 * pi * (k - 1) / fine)).norm();
    along.push_back(along.back() + step);
  }
  const int edges = nodes - 1;
  std::vector<double> at = {0};
  for (int k = 0; k < edges; ++k) at.push_back(at.back() + (k >= edges / 5 && k < edges - edges / 5 ? 1 : 8));
  std::vector<Vector3> result;
  for (const double place : at) {
    const double wanted = place / at.back() * along.back();
    auto above = static_cast<std::size_t>(std::lower_bound(along.begin(), along.end(), wanted) - along.begin());
    above = std::clamp<std::size_t>(above, 1, fine);
    const double share = (wanted - along[above - 1]) / (along[above] - along[above - 1]);
    const Vector3 p = on_profile(profile, 2 * pi * (static_cast<double>(above) - 1 + share) / fine);
    result.emplace_back(std::round(p.x() * 1e5) / 1e5, std::round(p.y() * 1e5) / 1e5, 0);
  }
  return result;
}

double greatest_turn(const std::vector<Vector3>& nodes, bool closed) {
  double greatest = 0;
  const std::size_t count = nodes.size();
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < count; ++i) {
    const Vector3 before = nodes[i] - nodes[(i + count - 1) % count];
    const Vector3 after = nodes[(i + 1) % count] - nodes[i];
    greatest = std::max(greatest, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return greatest;
}

/// The greatest move of a node along the curve.
double greatest_slide(const std::vector<Vector3>& before, const std::vector<Vector3>& after) {
  double greatest = 0;
  for (std::size_t i = 1; i + 1 < before.size(); ++i) {
    const Vector3 along = (before[i + 1] - before[i - 1]).normalized();
    greatest = std::max(greatest, std::abs(along.dot(after[i] - before[i])));
  }
  return greatest;
}

constexpr Profile profiles[] = {{0, 0.4, 0.12}, {0.02, 0.4, 0.12}, {0.04, 0.4, 0.15}};

/// The fit to its own nodes, which must be within, smoother than they are, and bent most at the nose alone.
std::vector<Vector3> expect_fair_foil(const std::vector<Vector3>& nodes, double tolerance) {
  const PolygonCurve input(nodes);
  const FitResult result = fit_within(input, held_ends(nodes), tolerance);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  const PolygonCurve fitted(result.positions);
  EXPECT_LE(distance(nodes, fitted).greatest, tolerance);
  const CurveFigures before = measure_curve(input);
  const CurveFigures after = measure_curve(fitted);
  EXPECT_EQ(after.inflections, 0);
  EXPECT_EQ(after.curvature_extrema, 1);
  EXPECT_LE(after.curvature_variation, before.curvature_variation);
  EXPECT_LE(after.neighbouring_edge_spread, 1.05 * before.neighbouring_edge_spread);
  return result.positions;
}

TEST(FitOwnNodes, ProfilesFromTablesLoseTheRoundingAndKeepTheNose) {
  for (const Profile& profile : profiles) {
    for (const int count : {60, 160}) {
      SCOPED_TRACE(::testing::Message() << profile.camber << " " << count);
      const auto nodes = foil(profile, count);
      EXPECT_NEAR(measure_curve(PolygonCurve(nodes)).neighbouring_edge_spread, 8, 0.1);
      const auto result = expect_fair_foil(nodes, 1e-5);
      EXPECT_LE(greatest_distance(result, nodes), 2e-5);
    }
  }
}

TEST(FitOwnNodes, ProfilesLoseNoise) {
  for (const Profile& profile : profiles) {
    for (const int count : {60, 160}) {
      SCOPED_TRACE(::testing::Message() << profile.camber << " " << count);
      const auto exact = foil(profile, count);
      const auto nodes = noisy(exact, held_ends(exact), 2e-4, 1, true);
      EXPECT_GT(measure_curve(PolygonCurve(nodes)).inflections, 5);
      (void)expect_fair_foil(nodes, 3e-4);
    }
  }
}

TEST(FitOwnNodes, NodesKeepTheirPlacesAlongTheCurve) {
  for (const double tolerance : {1e-4, 1e-3}) {
    SCOPED_TRACE(tolerance);
    const auto nodes = foil(profiles[1], 100);
    const FitResult result = fit_within(PolygonCurve(nodes), held_ends(nodes), tolerance);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LT(greatest_slide(nodes, result.positions), tolerance);
    EXPECT_GT(greatest_distance(nodes, result.positions), 0.5 * tolerance) << "or it would show nothing";
  }
}

TEST(FitOwnNodes, ClosedOutlinesLoseNoiseOfHalfTheSpacing) {
  const double spacing = 2 * pi / 120;
  for (const double waves : {0.0, 0.15}) {
    std::vector<Vector3> outline;
    for (int k = 0; k < 120; ++k) {
      const double angle = 2 * pi * k / 120;
      outline.emplace_back((1 + waves * (std::cos(2 * angle) + std::sin(3 * angle) / 3)) * heading(angle));
    }
    for (const std::uint64_t seed : {1U, 2U}) {
      SCOPED_TRACE(::testing::Message() << waves << " " << seed);
      const auto nodes = noisy(outline, Constraints(120), spacing / 2, seed, true);
      EXPECT_GT(greatest_turn(nodes, true), pi / 2);
      const FitResult result = fit_within(PolygonCurve(nodes, true), Constraints(120), 2 * spacing);
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      const PolygonCurve fitted(result.positions, true);
      EXPECT_LE(distance(nodes, fitted).greatest, 2 * spacing);
      EXPECT_LT(greatest_turn(result.positions, true), 10 * degree);
      EXPECT_LE(measure_curve(fitted).inflections, measure_curve(PolygonCurve(outline, true)).inflections);
      EXPECT_LE(measure_curve(fitted).curvature_extrema, measure_curve(PolygonCurve(outline, true)).curvature_extrema);
    }
  }
}

TEST(FitOwnNodes, TracksLoseNoiseOfAWholeSpacing) {
  std::vector<Vector3> way;
  for (const double at : places(Spacing::even, 100)) way.emplace_back(at, 0.1 * std::sin(9 * at), 0);
  const Constraints held = held_ends(way);
  for (const bool planar : {true, false}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(::testing::Message() << planar << " " << seed);
      const auto nodes = noisy(way, held, 0.01, seed, planar);
      EXPECT_GT(greatest_turn(nodes, false), 150 * degree);
      const FitResult result = fit_within(PolygonCurve(nodes), held, 0.02);
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_LE(distance(nodes, PolygonCurve(result.positions)).greatest, 0.02);
      EXPECT_LT(greatest_turn(result.positions, false), pi / 2);
    }
  }
}

TEST(FitOwnNodes, ACurveThatIsSmoothedBeyondItsSharpestBendIsNotInflated) {
  // At the nose the radius is a twelfth of this length: what springs and points agree on, if anything, is a balloon.
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 24; ++k)
    nodes.push_back(on_profile({.camber = 0.02, .camber_at = 0.4, .thickness = 0.12}, 2 * pi * k / 24));
  const PolygonCurve curve(nodes);
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  options.criterion = SmoothingLength{0.2};
  const Constraints held = held_ends(curve.positions());
  const FitResult result = fit(curve, held, {.positions = curve.positions()}, options);
  const auto height = [](const std::vector<Vector3>& positions) {
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end(),
                                                 [](const Vector3& a, const Vector3& b) { return a.y() < b.y(); });
    return high->y() - low->y();
  };
  EXPECT_LT(height(result.positions), 1.2 * height(curve.positions()));
  EXPECT_EQ(result.report.fair.outcome == Outcome::converged, result.report.fair.warnings.empty());
}

TEST(FitOwnNodes, ARootMeanSquareKeepsFewNodesOfAnEightOnIt) {
  // Edges of 1 to 4: over the longest, where the bend changes its side, the arc rises many times as far as noise goes.
  std::vector<double> at = {0};
  for (int k = 0; k < 18; ++k) at.push_back(at.back() + 2.5 - 1.5 * std::cos(2 * pi * k / 18));
  std::vector<Vector3> exact;
  for (std::size_t k = 0; k < 18; ++k) {
    const double angle = 2 * pi * (at[k] / at.back()) + 0.3;
    exact.emplace_back(std::sin(angle), 0.8 * std::sin(angle) * std::cos(angle), 0);
  }
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto nodes = noisy(exact, Constraints(18), 0.003, seed, true);
    const PolygonCurve input(nodes, true);
    FitOptions options;
    options.fair.distribution = Distribution::keep;
    options.criterion = RootMeanSquare{0.002};
    const FitResult result = fit(input, Constraints(18), {.positions = nodes}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << seed;
    EXPECT_LE(result.report.after.all.rms, 0.002) << seed;
    EXPECT_LT(greatest_distance(result.positions, nodes), 0.02) << seed;
  }
}

TEST(FitOwnNodes, NewNodesByTheCosineAreFreeOfNoiseTooWithinATolerance) {
  // At the nose a smoothing length must be so short that it leaves noise elsewhere: from there it is a long way down.
  std::vector<Vector3> nodes;
  Draw draw(1);
  for (int k = 0; k <= 160; ++k) {
    Vector3 noise = k == 0 || k == 160 ? Vector3(Vector3::Zero()) : draw.in_cube(0.0003);
    noise.z() = 0;
    nodes.emplace_back(on_profile({.camber = 0.02, .camber_at = 0.4, .thickness = 0.12}, 2 * pi * k / 160) + noise);
  }
  const PolygonCurve table(nodes);
  const Resampled resampled =
      resample(table, Constraints(table.node_count()), {.nodes = 120, .by = ResamplingBy::cosine});
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  options.criterion = Within{0.00036};
  const Constraints held = held_ends(resampled.curve.positions());
  const FitResult result = fit(resampled.curve, held, {.positions = nodes}, options);
  EXPECT_LE(result.report.after.all.greatest, *options.within());
  EXPECT_GT(result.report.after.all.greatest, 0.9 * *options.within());
  const CurveFigures before = measure_curve(resampled.curve);
  const CurveFigures after = measure_curve(PolygonCurve(result.positions));
  EXPECT_GT(before.inflections, 10);
  EXPECT_LE(after.inflections, 1);
  EXPECT_LT(after.curvature_extrema, 10);
}

}  // namespace
}  // namespace vspring::fit_own_nodes_test
