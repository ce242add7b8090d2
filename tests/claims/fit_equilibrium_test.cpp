// Fits to scattered points by the solver of the equilibrium.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/fairness_of.hpp"
#include "support/fits.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_equilibrium_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

/// A plane with points in waves over it.
FitSpecimen<PolygonMesh> wavy_plane(generate::Faces faces, int cells = 12) {
  const PolygonMesh plane = generate::plane({.columns = cells, .rows = cells, .faces = faces});
  ScatteredPoints points;
  const PolygonMesh dense = generate::plane({.columns = 30, .rows = 30});
  for (const Vector3& p : dense.positions())
    points.positions.emplace_back(p.x(), p.y(), 0.1 * std::sin(pi * p.x()) * std::sin(2 * pi * p.y()));
  return {plane, held_boundary(plane), points};
}

template <typename Shape>
void expect_the_same_as_sweeps(const FitSpecimen<Shape>& specimen, double weight, int sweeps,
                               Distribution distribution = Distribution::even) {
  FitOptions options = to_equilibrium(weight, 1e-8);
  options.fair.distribution = distribution;
  const FitResult equilibrium = specimen.fit(options);
  EXPECT_EQ(equilibrium.report.fair.outcome, Outcome::converged);
  options = by_sweeps(weight, 1e-9, sweeps);
  options.fair.distribution = distribution;
  const FitResult swept = specimen.fit(options);
  EXPECT_EQ(swept.report.fair.outcome, Outcome::converged);
  EXPECT_LT(greatest_distance(equilibrium.positions, swept.positions), 1e-6);
  EXPECT_EQ(equilibrium.report.pulling_points, swept.report.pulling_points);
  EXPECT_EQ(equilibrium.report.pulled_nodes, swept.report.pulled_nodes);
}

TEST(FitEquilibrium, IsWhereSweepsEnd) {
  for (const double weight : {1.0, 0.01, 1e-3}) expect_the_same_as_sweeps(noisy_wave(40), weight, 50000);
  for (const auto faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    expect_the_same_as_sweeps(wavy_plane(faces), 0.05, 20000);
    if (faces != generate::Faces::hexagons)
      expect_the_same_as_sweeps(wavy_plane(faces), 0.05, 20000, Distribution::keep);
  }
}

/// options: of equilibrium and V-cycle alike.
template <typename Shape>
void expect_the_same_by_cycles(const FitSpecimen<Shape>& specimen, FitOptions options) {
  options.fair.distribution = Distribution::even;
  options.fair.method = EquilibriumMethod{.tolerance = 1e-8};
  const FitResult equilibrium = specimen.fit(options);
  EXPECT_EQ(equilibrium.report.fair.outcome, Outcome::converged);
  options.fair.method = MultigridMethod{.step_tolerance = 1e-8, .max_iterations = 50000, .levels = 3};
  options.fair.accept_worse = true;
  const FitResult cycled = specimen.fit(options);
  EXPECT_EQ(cycled.report.fair.method, Method::multigrid);
  EXPECT_EQ(cycled.report.fair.outcome, Outcome::converged);
  ASSERT_EQ(cycled.report.fair.levels.size(), 3U);
  EXPECT_EQ(cycled.report.pulling_points, equilibrium.report.pulling_points);
  EXPECT_LT(greatest_distance(equilibrium.positions, cycled.positions), 1e-5);
}

/// Of a cycle on few levels the coarser ones are dropped; points must stay tied to the nodes of the finest.
template <typename Shape>
void expect_a_cycle_of_one_level_to_be_sweeps(const FitSpecimen<Shape>& specimen) {
  FitOptions options = by_sweeps(0.05, 1e-5, 2000);
  const FitResult swept = specimen.fit(options);
  options.fair.method = MultigridMethod{.step_tolerance = 1e-5, .max_iterations = 2000, .levels = 1};
  const FitResult cycled = specimen.fit(options);
  EXPECT_EQ(cycled.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(cycled.report.fair.iterations, swept.report.fair.iterations);
  EXPECT_EQ(cycled.positions, swept.positions);
}

TEST(FitEquilibrium, ACycleOfOneLevelIsThePlainIteration) {
  expect_a_cycle_of_one_level_to_be_sweeps(noisy_wave(100, 0.0005));
  expect_a_cycle_of_one_level_to_be_sweeps(wavy_plane(generate::Faces::triangles, 16));
}

TEST(FitEquilibrium, IsWhereTheVCycleEnds) {
  expect_the_same_by_cycles(noisy_wave(100, 0.0005), {.criterion = Weight{1e-3}});
  expect_the_same_by_cycles(noisy_wave(100, 0.0005), {.criterion = SmoothingLength{0.05}});
  for (const auto faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    expect_the_same_by_cycles(wavy_plane(faces, 16), {.criterion = Weight{0.01}});
  }
}

TEST(FitEquilibrium, IsTheDefault) {
  const auto wave = noisy_wave(40);
  const FitResult result = wave.fit({.criterion = Weight{0.01}});
  EXPECT_EQ(result.report.fair.method, Method::equilibrium);
  EXPECT_EQ(result.positions, wave.fit(to_equilibrium(0.01)).positions);
  const FitResult surface = wavy_plane(generate::Faces::quads).fit({.criterion = Weight{0.01}});
  EXPECT_EQ(surface.report.fair.method, Method::equilibrium);
  ASSERT_TRUE(surface.report.fair.expected_error.has_value());
}

TEST(FitEquilibrium, WithoutWeightIsPlainFairingToTheBit) {
  const auto wave = noisy_wave(60);
  EXPECT_EQ(wave.fit({.criterion = Weight{0}}).positions, fair(wave.start, wave.held).positions);
  auto cap = flat_cap(500, on_the_sphere(100));
  EXPECT_EQ(cap.fit({.criterion = Weight{0}}).positions, fair(cap.start, cap.held).positions);
  cap.points.weights.assign(100, 0);
  EXPECT_EQ(cap.fit({}).positions, fair(cap.start, cap.held).positions);
}

TEST(FitEquilibrium, HoldsForEveryWeight) {
  const auto wave = noisy_wave(60, 0.0005);
  auto cap = flat_cap(500, on_the_sphere(2000));
  const FairResult fair_wave = fair(wave.start, wave.held, to_equilibrium(0, 1e-8).fair);
  for (const double weight : {1e-12, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e6, 1e12, 1e50}) {
    SCOPED_TRACE(weight);
    const FitResult on_curve = wave.fit(to_equilibrium(weight, 1e-7));
    EXPECT_EQ(on_curve.report.fair.outcome, Outcome::converged);
    if (weight >= 1e6) {
      // What is left is how far the points lie from chords.
      EXPECT_LT(on_curve.report.after.all.greatest, 5e-4);
      EXPECT_LT(greatest_distance(on_curve.positions, wave.fit(to_equilibrium(1e50, 1e-7)).positions), 1e-5);
    }
    if (weight <= 1e-12) {
      EXPECT_LT(greatest_distance(on_curve.positions, fair_wave.positions), 2e-4);
    }
    const FitResult on_surface = cap.fit(to_equilibrium(weight));
    EXPECT_EQ(on_surface.report.fair.outcome, Outcome::converged);
    EXPECT_LT(distance_from_unit_sphere(on_surface.positions), 2e-3);
  }
}

/// How far the result for a tolerance is from that for a far smaller one, and how far it is expected to be.
template <typename Shape>
void expect_errors_as_expected(const FitSpecimen<Shape>& specimen, double size, double weight) {
  const FitResult exact = specimen.fit(to_equilibrium(weight, 1e-12));
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    SCOPED_TRACE(tolerance);
    const FitResult result = specimen.fit(to_equilibrium(weight, tolerance));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    const double error = greatest_distance(result.positions, exact.positions) / size;
    const double expected = result.report.fair.expected_error.value();
    EXPECT_LE(expected, tolerance);
    EXPECT_LT(error, 3 * expected);
    EXPECT_GT(error, expected / 10);
  }
}

TEST(FitEquilibrium, SaysHowFarItIsFromTheEquilibrium) {
  for (const double weight : {1.0, 0.01, 1e-5}) {
    SCOPED_TRACE(weight);
    expect_errors_as_expected(noisy_wave(50, 0.0005), diagonal(noisy_wave(50).start.positions()), weight);
    const auto plane = wavy_plane(generate::Faces::quads);
    expect_errors_as_expected(plane, diagonal(plane.start), weight);
  }
}

TEST(FitEquilibrium, NeedsFewIterationsOnLargeShapes) {
  const FitResult curve = noisy_wave(4000, 1e-5).fit(to_equilibrium(1e-9));
  EXPECT_EQ(curve.report.fair.outcome, Outcome::converged);
  EXPECT_LT(curve.report.fair.levels.back().iterations, 15);
  const FitResult cap = flat_cap(5000, on_the_sphere(2000)).fit(to_equilibrium(1e-3));
  EXPECT_EQ(cap.report.fair.outcome, Outcome::converged);
  EXPECT_LT(cap.report.fair.levels.back().iterations, 15);
  EXPECT_LT(distance_from_unit_sphere(cap.positions), 2e-4);
}

TEST(FitEquilibrium, TiesGoWithTheNodes) {
  // All points begin at the end node that is nearest to them.
  const PolygonCurve segment(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 40)));
  ScatteredPoints points;
  for (int j = 0; j <= 100; ++j) points.positions.emplace_back(Vector3(0.5, 0, 0) + 0.5 * heading(pi * j / 100));
  const FitResult result = fit(segment, held_ends(segment.positions()), points, to_equilibrium(0.05));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(result.report.after.percentile99, 0.01);
  EXPECT_GT(result.report.pulled_nodes, 35);
}

TEST(FitEquilibrium, EndsThoughTiesGoToAndFro) {
  // Points in the middle between nodes, above and below: whichever node they pull at comes nearer or goes away.
  const int edges = 30;
  const PolygonCurve segment(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges)));
  ScatteredPoints points;
  for (int j = 0; j < edges; ++j)
    points.positions.emplace_back((j + 0.5) / edges, (j % 2 == 0 ? 0.3 : -0.3) / edges, 0);
  for (const double weight : {0.01, 1.0, 100.0}) {
    const FitResult result = fit(segment, held_ends(segment.positions()), points, to_equilibrium(weight));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << weight;
    EXPECT_LT(result.report.fair.iterations, 200);
  }
}

TEST(FitEquilibrium, OnePointDrawsAllNodes) {
  const PolygonCurve segment(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 20)));
  const FitResult curve =
      fit(segment, held_ends(segment.positions()), {.positions = {{0.5, 0.1, 0}}}, to_equilibrium(1));
  EXPECT_EQ(curve.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(curve.report.pulling_points, 1);
  EXPECT_LT(curve.report.after.all.greatest, 1e-3);
  for (std::size_t i = 1; i < 20; ++i) EXPECT_GT(curve.positions[i].y(), 0);
  auto plane = wavy_plane(generate::Faces::mixed);
  plane.points = {.positions = {{0.5, 0.5, 0.1}}};
  const FitResult surface = plane.fit(to_equilibrium(100));
  EXPECT_EQ(surface.report.fair.outcome, Outcome::converged);
  EXPECT_LT(surface.report.after.all.greatest, 5e-3);
}

TEST(FitEquilibrium, FewerPointsThanNodesLeaveItFairBetweenThem) {
  const FitResult result = flat_cap(500, on_the_sphere(30)).fit(to_equilibrium(0.1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.pulled_nodes, 30);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 2e-3);
}

TEST(FitEquilibrium, ThousandsOfPointsOnOneNodePullLikeTheirAverage) {
  const PolygonCurve segment(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 120)));
  ScatteredPoints points;
  points.positions.assign(5000, {0.5, 0.1, 0});
  const Constraints held = held_ends(segment.positions());
  const FitResult many = fit(segment, held, points, to_equilibrium(0.1, 1e-9));
  EXPECT_EQ(many.report.most_points, 5000);
  const FitResult one = fit(segment, held, {.positions = {{0.5, 0.1, 0}}}, to_equilibrium(0.1, 1e-9));
  EXPECT_LT(greatest_distance(many.positions, one.positions), 1e-8);
}

TEST(FitEquilibrium, PointsMayBeFarAway) {
  auto plane = wavy_plane(generate::Faces::triangles, 8);
  for (const double away : {3.0, 100.0, 1e12, 1e40}) {
    SCOPED_TRACE(away);
    plane.points = {.positions = {{0.5, 0.5, away}}};
    const FitResult surface = plane.fit(to_equilibrium(0.01));
    const auto wave = noisy_wave(100);
    const FitResult curve = fit(wave.start, wave.held, plane.points, to_equilibrium(1e50));
    for (const FitResult* result : {&surface, &curve}) {
      for (const Vector3& position : result->positions) EXPECT_TRUE(position.allFinite());
      EXPECT_TRUE(std::isfinite(result->report.after.all.rms));
      EXPECT_TRUE(std::isfinite(result->report.fair.expected_error.value()));
    }
  }
}

TEST(FitEquilibrium, AClosedCurveMayBeHeldByPointsAlone) {
  for (const int nodes : {40, 301}) {
    for (const bool tilted : {false, true}) {
      SCOPED_TRACE(nodes);
      const PolygonCurve points = circle(97, 1, tilted);
      const FitResult result =
          fit(circle(nodes, 0.8), Constraints(nodes), {.positions = points.positions()}, to_equilibrium(0.05));
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_LT(result.report.after.all.greatest, nodes == 40 ? 0.02 : 1e-3);
      if (!tilted) {
        EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-3);
      }
    }
  }
}

TEST(FitEquilibrium, AClosedSurfaceMayBeHeldByPointsAlone) {
  for (const int cells : {4, 8}) {
    PolygonMesh ball = closed_sphere(cells);
    std::vector<Vector3> small = ball.positions();
    for (Vector3& position : small) position *= 0.9;
    const FitResult result = fit(with_positions(ball, small), Constraints(ball.node_count()),
                                 {.positions = ball.positions()}, to_equilibrium(0.1));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << cells;
    EXPECT_LT(distance_from_unit_sphere(result.positions), 0.01);
  }
}

TEST(FitEquilibrium, ConstraintsHoldAtTheSameTime) {
  auto cap = flat_cap(217, on_the_sphere(2000));
  cap.held.fix_position(30, cap.start.position(30) + Vector3(0, 0, 0.1));
  const FitResult result = cap.fit(to_equilibrium(0.1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  for (Index i = 0; i < cap.start.node_count(); ++i) {
    if (!cap.held.position_fixed(i)) continue;
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], cap.held.position(i));
  }
  const PolygonCurve segment(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 100)));
  const Constraints held = held_ends(segment.positions(), heading(0.5), heading(-0.5));
  const FitResult curve = fit(segment, held, {.positions = {{0.5, 0.2, 0}}}, to_equilibrium(0.01));
  const Vector3 start = (curve.positions[1] - curve.positions[0]).normalized();
  EXPECT_NEAR(std::atan2(start.y(), start.x()), 0.5, 0.03);
  EXPECT_LT(curve.report.after.all.greatest, 0.01);
}

TEST(FitEquilibrium, KeepsWorkingWithEveryRule) {
  for (const PseudoNormals kind : {PseudoNormals::average, PseudoNormals::area, PseudoNormals::angle}) {
    FitOptions options = to_equilibrium(0.1);
    options.fair.pseudo_normals = kind;
    const FitResult result = flat_cap(500, on_the_sphere(2000)).fit(options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 3e-3);
  }
  FitOptions keep = to_equilibrium(0.01);
  keep.fair.distribution = Distribution::keep;
  EXPECT_EQ(noisy_wave(60, 0.0005).fit(keep).report.fair.outcome, Outcome::converged);
  EXPECT_EQ(wavy_plane(generate::Faces::quads).fit(keep).report.fair.outcome, Outcome::converged);
}

/// Noise of so many edges taken off a closed cube of 6 × 6 quads a side by a fit to its own nodes, which keep their
/// distribution. Returns the result, and how far nodes are from the cube as a share of how far they were.
std::pair<FitResult, double> cleaned_cube(double noise, double smoothing_length) {
  constexpr int cells = 6;
  const double edge = 1.0 / cells;
  const PolygonMesh cube = generate::genus({.holes = 0, .cells = cells});
  const PolygonMesh noisy = generate::add_noise(cube, noise * edge, 1);
  FitOptions options;
  options.criterion = SmoothingLength{smoothing_length * edge};
  options.fair.distribution = Distribution::keep;
  FitResult result = fit(noisy, Constraints(cube.node_count()), {.positions = noisy.positions()}, options);
  const double share = distance(result.positions, cube).rms / distance(noisy.positions(), cube).rms;
  return {std::move(result), share};
}

TEST(FitEquilibrium, NodesThatKeepTheirDistributionDoNotSlideOffWhatIsSharp) {
  const auto [result, share] = cleaned_cube(0.3, 0.5);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(share, 0.8);
}

TEST(FitEquilibrium, BendsLessWhereNoiseHasFoldedFacesThatKeepTheirPlace) {
  const auto [result, share] = cleaned_cube(1, 0.3);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.method, Method::equilibrium);
  ASSERT_FALSE(result.report.fair.warnings.empty());
  EXPECT_EQ(result.report.fair.warnings.back().code, WarningCode::other_fairness);
  EXPECT_LT(share, 1);
}

TEST(FitEquilibrium, WhereThereIsNoneForACurveItIsDrawnWithNodesOfItsOwn) {
  // Points that crumple the curve: neighbours are drawn apart by more than an edge.
  const auto crumpled = noisy_wave(200, 0.004);
  const FitResult result = crumpled.fit({.criterion = Weight{1}});
  EXPECT_EQ(result.report.fair.method, Method::equilibrium);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_TRUE(result.report.fair.warnings.empty());
  EXPECT_EQ(result.report.fair.levels.back().strategy, std::string("curve through points"));
  EXPECT_LT(result.report.after.all.rms, 0.004);
  const auto [before, after] = fairness_of(crumpled.start, crumpled.held, result.positions);
  EXPECT_LT(after.vspring_energy, 0.2 * before.vspring_energy);
  // Who names the method and no fallbacks gets what it found.
  FitOptions alone{.criterion = Weight{1}};
  alone.fair.method = EquilibriumMethod{.fallbacks = false};
  EXPECT_NE(crumpled.fit(alone).report.fair.outcome, Outcome::converged);
}

TEST(FitEquilibrium, WhereItFindsNothingForBricksThatKeepTheirPlaceLessBendingDoes) {
  FitOptions options{.criterion = Weight{0.05}};
  options.fair.distribution = Distribution::keep;
  const FitResult result = wavy_plane(generate::Faces::hexagons).fit(options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  ASSERT_FALSE(result.report.fair.warnings.empty());
  EXPECT_EQ(result.report.fair.warnings.back().code, WarningCode::other_fairness);
}

TEST(FitEquilibrium, SmoothsByLessWhereWhatIsAskedForLeadsToNothing) {
  // Of twice its radius: the bent tube would cross itself.
  const PolygonMesh tube = bent_tube(16, 24, 0.3, 3.5);
  const Constraints held = held_boundary(tube);
  const ScatteredPoints own{.positions = tube.positions()};
  const FitResult asked = fit(tube, held, own, {.criterion = SmoothingLength{1.2}});
  EXPECT_EQ(asked.report.fair.outcome, Outcome::converged);
  ASSERT_FALSE(asked.report.fair.warnings.empty());
  EXPECT_EQ(asked.report.fair.warnings.back().code, WarningCode::smoothed_less);
  EXPECT_NE(asked.report.fair.warnings.back().text.find("the shape with 0.3"), std::string::npos);
  EXPECT_EQ(asked.report.smoothing_length, 0.3);
  EXPECT_EQ(asked.positions, fit(tube, held, own, {.criterion = SmoothingLength{0.3}}).positions);
  EXPECT_NE(fit(tube, held, own, {.criterion = SmoothingLength{0.3}}).positions, tube.positions());
  // Who wants nothing else gets what there is.
  FitOptions alone{.criterion = SmoothingLength{1.2}};
  alone.fair.method = EquilibriumMethod{.fallbacks = false};
  EXPECT_NE(fit(tube, held, own, alone).report.fair.outcome, Outcome::converged);
}

TEST(FitEquilibrium, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto cap = flat_cap(4600, on_the_sphere(9000, 0.005));
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    FitOptions options = to_equilibrium(1e-3);
    options.fair.method = EquilibriumMethod{.max_iterations = 12};
    return fit(cap.start, cap.held, cap.points, options, context);
  };
  const FitResult one = run(1);
  for (const int threads : {2, 4}) EXPECT_EQ(one.positions, run(threads).positions);
}

TEST(FitEquilibrium, EndsWithTheShapeSoFarWhenCancelled) {
  const auto cap = flat_cap(500, on_the_sphere(1000));
  Context context;
  context.on_progress = [&](const Progress& /*progress*/) { context.cancel(); };
  const FitResult result = fit(cap.start, cap.held, cap.points, to_equilibrium(0.1), context);
  EXPECT_EQ(result.report.fair.outcome, Outcome::cancelled);
  EXPECT_EQ(result.positions, cap.start.positions());
}

TEST(FitEquilibrium, ScaleAndPlaceOfTheWholeMakeNoDifference) {
  const auto wave = noisy_wave(60, 0.0005);
  const FitOptions options = to_equilibrium(0.01, 1e-10);
  const FitResult plain = wave.fit(options);
  Motion motion;
  motion.scale = 1e6;
  const std::vector<Vector3> moved = motion.points(wave.start.positions());
  const FitResult other = fit(PolygonCurve(moved), motion.constraints(wave.held), {.positions = moved}, options);
  EXPECT_LT(greatest_distance(motion.points(plain.positions), other.positions), 1e-8 * motion.scale);
}

}  // namespace
}  // namespace vspring::fit_equilibrium_test
