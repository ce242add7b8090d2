// Between two ends with tangents a planar curve becomes the Euler spiral of these data (the G1 Hermite clothoid), with
// an error that falls with the square of the node spacing.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_clothoid_test {
namespace {

using namespace support;
using reference::Clothoid;

const Eigen::Vector2d from(0, 0);
const Eigen::Vector2d to(1, 0);

struct EndAngles {
  double start;  // degrees from the chord
  double end;
};

/// From the chord, with the places given.
std::vector<Vector3> on_chord(const std::vector<double>& at) { return straight(lifted(from), lifted(to), at); }

Constraints held(const std::vector<Vector3>& nodes, const EndAngles& angles) {
  return held_ends(nodes, heading(angles.start * degree), heading(angles.end * degree));
}

double error_of(const std::vector<Vector3>& start, const EndAngles& angles, const Clothoid& expected,
                const FairOptions& options = to_the_end()) {
  return distance_from(expected, faired(start, held(start, angles), options));
}

/// Errors of 33, 65 and 129 nodes, and so on.
std::vector<double> errors(int refinements, const std::function<double(int edges)>& error) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(refinements));
  for (int k = 0; k < refinements; ++k) all.push_back(error(32 << k));
  return all;
}

TEST(FairCurveClothoid, EveryPairOfEndTangentsGivesItsEulerSpiral) {
  int pairs = 0;
  for (int start = -135; start <= 135; start += 30) {
    for (int end = -135; end <= 135; end += 30) {
      if (std::abs(end - start) > 270) continue;
      const EndAngles angles = {static_cast<double>(start), static_cast<double>(end)};
      const Clothoid expected = reference::hermite_clothoid(from, start * degree, to, end * degree);
      const auto error =
          errors(3, [&](int edges) { return error_of(on_chord(places(Spacing::even, edges)), angles, expected); });
      SCOPED_TRACE(fmt::format("{}°, {}°: {:.2e} {:.2e} {:.2e}, length {}", start, end, error[0], error[1], error[2],
                               expected.length));
      ++pairs;
      EXPECT_LT(error[2], 1e-3 * expected.length);
      // A circle is exact already.
      if (error[2] < 1e-12) continue;
      EXPECT_GT(order(error[0], error[1]), 1.9);
      EXPECT_GT(order(error[1], error[2]), 1.9);
    }
  }
  EXPECT_GE(pairs, 50);
}

TEST(FairCurveClothoid, AsDoNoisyStarts) {
  for (const EndAngles& angles : {EndAngles{30, 60}, {75, -20}, {-100, 60}, {120, -120}, {0, 90}}) {
    const Clothoid expected = reference::hermite_clothoid(from, angles.start * degree, to, angles.end * degree);
    const auto error = errors(3, [&](int edges) {
      const auto chord = on_chord(places(Spacing::even, edges));
      return error_of(noisy(chord, held(chord, angles), 0.05, 9, true), angles, expected);
    });
    SCOPED_TRACE(fmt::format("{}, {}: {:.2e} {:.2e} {:.2e}", angles.start, angles.end, error[0], error[1], error[2]));
    EXPECT_LT(error[2], 1e-3);
    if (error[2] < 1e-12) continue;
    EXPECT_GT(order(error[0], error[1]), 1.9);
    EXPECT_GT(order(error[1], error[2]), 1.9);
  }
}

TEST(FairCurveClothoid, KeptSpacingDoesNotMatter) {
  struct Kept {
    Spacing spacing;
    double ratio;
  };
  for (const Kept& kept :
       {Kept{Spacing::alternating, 3}, {Spacing::graded, 100}, {Spacing::jump, 2}, {Spacing::jump, 10}}) {
    for (const EndAngles& angles : {EndAngles{60, 20}, {-80, 30}, {90, 40}}) {
      const Clothoid expected = reference::hermite_clothoid(from, angles.start * degree, to, angles.end * degree);
      const auto error = errors(4, [&](int edges) {
        return error_of(on_chord(places(kept.spacing, edges, kept.ratio)), angles, expected,
                        to_the_end(Distribution::keep));
      });
      SCOPED_TRACE(fmt::format("spacing {}, {}, {}: {:.2e} {:.2e} {:.2e} {:.2e}", static_cast<int>(kept.spacing),
                               angles.start, angles.end, error[0], error[1], error[2], error[3]));
      EXPECT_LT(error[3], 3e-3);
      for (std::size_t k = 1; k < 3; ++k) EXPECT_GT(order(error[k], error[k + 1]), 1.9);
    }
  }
}

TEST(FairCurveClothoid, NorDoesRandomSpacing) {
  // The mean over seeds, for each draws its own curve.
  const EndAngles angles = {-80, 30};
  const Clothoid expected = reference::hermite_clothoid(from, angles.start * degree, to, angles.end * degree);
  const auto error = errors(4, [&](int edges) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
      sum +=
          error_of(on_chord(places(Spacing::random, edges, 4, seed)), angles, expected, to_the_end(Distribution::keep));
    return sum / 10;
  });
  SCOPED_TRACE(fmt::format("{:.2e} {:.2e} {:.2e} {:.2e}", error[0], error[1], error[2], error[3]));
  EXPECT_LT(error[3], 1e-4);
  EXPECT_GT(order(error[0], error[3]), 3 * 1.9);
}

TEST(FairCurveClothoid, LargerTurnsAreFoundFromACoarseShapeOfThem) {
  // Beyond 270 degrees the data have several solutions, and the chord leads to one of them only.
  for (const EndAngles& angles : {EndAngles{-150, 150}, {-90, 210}, {0, 300}, {-45, 315}, {-45, 375}}) {
    const Clothoid expected =
        reference::hermite_clothoid_on_chord(from, to, angles.start * degree, angles.end * degree);
    const auto error = errors(3, [&](int edges) {
      const auto shape = sampled(expected, places(Spacing::even, edges));
      return error_of(noisy(shape, held(shape, angles), 0.01, 4, true), angles, expected);
    });
    SCOPED_TRACE(fmt::format("{}, {}: {:.2e} {:.2e} {:.2e}", angles.start, angles.end, error[0], error[1], error[2]));
    EXPECT_LT(error[2], 1e-3);
    if (error[2] < 1e-12) continue;
    EXPECT_GT(order(error[0], error[1]), 1.9);
    EXPECT_GT(order(error[1], error[2]), 1.9);
  }
}

TEST(FairCurveClothoid, AnEndWithoutATangentHasNoCurvature) {
  const Clothoid expected = reference::hermite_clothoid_spline({from, to}, 50 * degree).front();
  EXPECT_NEAR(expected.curvature_at(expected.length), 0, 1e-10);
  const auto error = errors(3, [&](int edges) {
    const auto chord = on_chord(places(Spacing::even, edges));
    Constraints constraints = held_ends(chord);
    constraints.fix_tangent(0, heading(50 * degree));
    return distance_from(expected, faired(chord, constraints));
  });
  SCOPED_TRACE(fmt::format("{:.2e} {:.2e} {:.2e}", error[0], error[1], error[2]));
  EXPECT_GT(order(error[0], error[1]), 1.9);
  EXPECT_GT(order(error[1], error[2]), 1.9);
}

TEST(FairCurveClothoid, ThePapersRulesGiveItForEvenSpacingOnly) {
  const EndAngles angles = {-80, 30};
  const Clothoid expected = reference::hermite_clothoid(from, angles.start * degree, to, angles.end * degree);
  FairOptions options = to_the_end(Distribution::keep);
  options.curve = CurveRules::paper();
  const auto error = [&](Spacing spacing, int edges) {
    const auto start = on_chord(places(spacing, edges, 1.2));
    const FairResult result = fair(PolygonCurve(start), held(start, angles), options);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    return distance_from(expected, result.positions);
  };
  const auto even = errors(3, [&](int edges) { return error(Spacing::even, edges); });
  const auto jump = errors(3, [&](int edges) { return error(Spacing::jump, edges); });
  SCOPED_TRACE(fmt::format("even {:.2e} {:.2e} {:.2e}, jump {:.2e} {:.2e} {:.2e}", even[0], even[1], even[2], jump[0],
                           jump[1], jump[2]));
  EXPECT_GT(order(even[0], even[1]), 1.9);
  EXPECT_GT(order(even[1], even[2]), 1.9);
  for (const double remaining : jump) EXPECT_GT(remaining, 1e-2);
}

TEST(FairCurveClothoid, ThePapersIterationComesToTheSameShape) {
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    const auto start = on_chord(places(Spacing::random, 16));
    const Constraints constraints = held(start, {60, 20});
    FairOptions options = to_the_end(distribution);
    const auto equilibrium = faired(start, constraints, options);
    options.method = SweepMethod{.step_tolerance = 1e-11, .max_iterations = 100000};
    // The last step is some hundredth of what is left to go, in edges.
    EXPECT_LT(greatest_distance(faired(start, constraints, options), equilibrium), 2e-9);
    EXPECT_GT(greatest_distance(start, equilibrium), 0.1);
  }
}

}  // namespace
}  // namespace vspring::fair_curve_clothoid_test
