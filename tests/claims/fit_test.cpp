// What fitting to scattered points is claimed to do.

#include "vspring/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/fits.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

/// A cap of the unit sphere pressed flat; its rim is held, with the normals of the sphere.
struct FlatCap {
  PolygonMesh cap = generate::cap({.nodes = 217, .radius = 1, .half_angle = 60});
  PolygonMesh flat = flattened(cap, 60, 0);
  Constraints held = held_boundary(flat, radial);
};

TEST(Fit, PointsOnASpherePullAFlatCapOntoIt) {
  const FlatCap start;
  const FitResult result = fit(start.flat, start.held, on_the_sphere(2000), by_sweeps(0.1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_GT(result.report.before.all.greatest, 0.4);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 2e-3);
  // What is left is mostly the distance of the sphere from its chords.
  EXPECT_LT(result.report.after.all.greatest, 0.01);
  EXPECT_GT(result.report.pulled_nodes, 150);
}

TEST(Fit, ManyNoisyPointsAverageOut) {
  const FlatCap start;
  const FitResult result = fit(start.flat, start.held, on_the_sphere(10000, 0.05), by_sweeps(0.001, 1e-6));
  EXPECT_LT(distance_from_unit_sphere(result.positions), 5e-3);
}

TEST(Fit, PointsOnAPlaneFlattenAMeshOfEveryKind) {
  for (const auto faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12, .faces = faces});
    const PolygonMesh bumpy = generate::add_noise(plane, 0.03, 3);
    Constraints held(plane.node_count());
    fix_boundary_positions(held, plane);
    const FitResult result = fit(bumpy, held, {.positions = plane.positions()}, by_sweeps(1, 1e-9));
    for (const Vector3& position : result.positions) EXPECT_NEAR(position.z(), 0, 1e-6);
  }
}

TEST(Fit, PointsOnACirclePullAClosedCurveThatNothingElseHolds) {
  const PolygonCurve small = circle(40, 0.8);
  const ScatteredPoints points{.positions = circle(97, 1).positions()};
  const FitResult result = fit(small, Constraints(40), points, by_sweeps(0.05));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-3);
  EXPECT_THROW((void)fair(small, Constraints(40)), Error);
}

TEST(Fit, AClosedSurfaceMayBeHeldByPointsAlone) {
  PolygonMesh ball = closed_sphere(4);
  std::vector<Vector3> small = ball.positions();
  for (Vector3& position : small) position *= 0.9;
  const FitResult result = fit(with_positions(ball, small), Constraints(ball.node_count()),
                               {.positions = ball.positions()}, by_sweeps(0.1, 1e-3));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 0.01);
}

TEST(Fit, WithoutWeightItIsPlainFairingToTheBit) {
  const FlatCap start;
  FitOptions options = by_sweeps(0, 1e-4);
  options.fair.method = SweepMethod{};
  const FairResult plain = fair(start.flat, start.held, options.fair);
  EXPECT_EQ(fit(start.flat, start.held, on_the_sphere(100), options).positions, plain.positions);
  ScatteredPoints unweighted = on_the_sphere(100);
  unweighted.weights.assign(100, 0);
  options.criterion = Weight{1};
  const FitResult result = fit(start.flat, start.held, unweighted, options);
  EXPECT_EQ(result.positions, plain.positions);
  EXPECT_EQ(result.report.pulling_points, 0);

  const PolygonCurve bent(noisy(segment(30).positions(), held_ends(segment(30).positions()), 0.01, 1, true));
  const Constraints ends = held_ends(bent.positions());
  EXPECT_EQ(fit(bent, ends, on_the_sphere(10), by_sweeps(0)).positions, fair(bent, ends, by_sweeps(0).fair).positions);
}

TEST(Fit, AHugeWeightInterpolatesOnePointForEveryNode) {
  const PolygonCurve curve = segment(40);
  ScatteredPoints points;
  for (const Vector3& p : curve.positions()) points.positions.emplace_back(p.x(), 0.05 * std::sin(2 * pi * p.x()), 0);
  const FlatCap start;
  for (const FitOptions& options : {by_sweeps(1e6, 1e-6), to_equilibrium(1e6)}) {
    const FitResult on_curve = fit(curve, held_ends(curve.positions()), points, options);
    EXPECT_EQ(on_curve.report.fair.outcome, Outcome::converged);
    EXPECT_GT(on_curve.report.before.all.greatest, 0.049);
    EXPECT_LT(on_curve.report.after.all.greatest, 2e-4);

    const FitResult on_surface = fit(start.flat, start.held, {.positions = start.cap.positions()}, options);
    EXPECT_EQ(on_surface.report.fair.outcome, Outcome::converged);
    // Nodes slide between the points, which are then as far as chords are from the sphere.
    EXPECT_LT(on_surface.report.after.all.rms, on_surface.report.before.all.rms / 100);
  }
}

TEST(Fit, FixedNodesStayToTheBit) {
  FlatCap start;
  start.held.fix_position(30, start.flat.position(30) + Vector3(0, 0, 0.1));
  const FitResult result = fit(start.flat, start.held, on_the_sphere(2000), by_sweeps(0.1));
  for (Index i = 0; i < start.flat.node_count(); ++i) {
    if (!start.held.position_fixed(i)) continue;
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], start.held.position(i));
  }
}

TEST(Fit, GivenNormalsHoldWhilePointsPull) {
  const FlatCap start;
  const ScatteredPoints pulling{.positions = {{0, 0, 1.1}}};
  const auto lean = [&](const Constraints& held) {
    const PolygonMesh fitted = with_positions(start.flat, fit(start.flat, held, pulling, by_sweeps(0.1)).positions);
    double greatest = 0;
    const auto loops = boundary_loops(fitted);
    for (const Index i : loops.front()) {
      const Index node[] = {i};
      greatest = std::max(greatest, estimate_normals(fitted, node)[0].cross(radial(start.cap.position(i))).norm());
    }
    return greatest;
  };
  EXPECT_LT(lean(start.held), 0.1);
  EXPECT_GT(lean(held_boundary(start.flat)), 0.2);
}

TEST(Fit, ATangentHoldsWhileACurveIsPulled) {
  const PolygonCurve curve = segment(40);
  const Constraints held = held_ends(curve.positions(), heading(0.5), heading(-0.5));
  const ScatteredPoints points{.positions = {{0.5, 0.2, 0}}};
  const FitResult result = fit(curve, held, points, by_sweeps(0.01, 1e-7, 200000));
  const Vector3 start = (result.positions[1] - result.positions[0]).normalized();
  EXPECT_NEAR(std::atan2(start.y(), start.x()), 0.5, 0.03);
  EXPECT_LT(result.report.after.all.greatest, result.report.before.all.greatest / 5);
}

TEST(Fit, ScaleAndPlaceOfTheWholeMakeNoDifference) {
  const PolygonCurve curve = segment(30);
  Draw draw(3);
  ScatteredPoints points;
  for (int j = 0; j < 50; ++j) points.positions.emplace_back(draw.uniform(0, 1), draw.uniform(0, 0.1), 0);
  const FitOptions options = by_sweeps(0.05, 1e-6);
  const FitResult plain = fit(curve, held_ends(curve.positions()), points, options);
  Motion motion;
  motion.scale = 1e6;
  const std::vector<Vector3> moved = motion.points(curve.positions());
  const FitResult other =
      fit(PolygonCurve(moved), held_ends(moved), {.positions = motion.points(points.positions)}, options);
  EXPECT_LT(greatest_distance(motion.points(plain.positions), other.positions), 1e-9 * motion.scale);
}

TEST(FitThreads, GiveTheSameBitsForEveryNumber) {
  const PolygonMesh cap = generate::cap({.nodes = 3000, .radius = 1, .half_angle = 60});
  const PolygonMesh flat = flattened(cap, 60, 0.01);
  const ScatteredPoints points = on_the_sphere(9000, 0.01);
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fit(flat, held_boundary(flat), points, by_sweeps(0.1, 1e-12, 60), context);
  };
  const FitResult one = run(1);
  for (const int threads : {2, 3}) {
    const FitResult other = run(threads);
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.distances, other.distances);
  }
}

TEST(Fit, EndsAndBoundariesMustBeHeldAllTheSame) {
  const PolygonCurve curve = segment(10);
  FitOptions sweeps;
  sweeps.fair.method = SweepMethod{};
  EXPECT_THROW((void)fit(curve, Constraints(11), {.positions = curve.positions()}, sweeps), Error);
  // But ends of a curve that is drawn to points may follow them.
  EXPECT_EQ(fit(curve, Constraints(11), {.positions = curve.positions()}).report.fair.outcome, Outcome::converged);
  const PolygonMesh plane = generate::plane({.columns = 4, .rows = 4});
  EXPECT_THROW((void)fit(plane, Constraints(plane.node_count()), {.positions = plane.positions()}), Error);
  EXPECT_THROW((void)fit(plane, Constraints(3), {.positions = plane.positions()}), Error);
}

TEST(Fit, EndsWithTheShapeSoFarWhenCancelled) {
  const FlatCap start;
  Context context;
  context.on_progress = [&](const Progress& /*progress*/) { context.cancel(); };
  const FitResult result = fit(start.flat, start.held, on_the_sphere(1000), by_sweeps(0.1, 1e-12), context);
  EXPECT_EQ(result.report.fair.outcome, Outcome::cancelled);
  EXPECT_EQ(result.positions, start.flat.positions());
  EXPECT_EQ(result.report.after.all.count + result.report.at_held.count, 1000);
}

/// Fig. 11: the nodes of a wavy curve are its points. By what share a wave of small height is kept.
double gain(double weight, int waves, int edges) {
  const double height = 0.02 / edges;
  std::vector<Vector3> nodes = segment(edges).positions();
  for (Vector3& node : nodes) node.y() = height * std::sin(2 * pi * waves * node.x());
  const FitResult result =
      fit(PolygonCurve(nodes), held_ends(nodes), {.positions = nodes}, to_equilibrium(weight, 1e-9));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  double sum = 0;
  for (const Vector3& node : result.positions) sum += node.y() * std::sin(2 * pi * waves * node.x());
  return 2 * sum / edges / height;
}

TEST(Fit, AWaveKeepsTheShareThatTheSmoothingSplineLeavesIt) {
  // The cut lies at waves of 12 edges for k = 0.01 and of 66 for k = 0.00001.
  struct {
    double weight;
    int waves;
    int edges;
  } const specimens[] = {{0.01, 8, 240}, {0.01, 20, 240}, {0.01, 40, 240},
                         {1e-5, 1, 90},  {1e-5, 2, 120},  {1e-5, 4, 120}};
  for (const auto& [weight, waves, edges] : specimens) {
    SCOPED_TRACE(testing::Message() << weight << " " << waves);
    const double kept = gain(weight, waves, edges);
    // The ends count for a little. Of what is to be made least, ∫h″² + λ⁻⁴ (v − h)² with k = (ℓ/λ)⁴/8, the one for
    // nodes and the one for curves.
    const double step = 2 * pi * waves / edges;
    EXPECT_NEAR(kept, 1 / (1 + std::pow(2 - 2 * std::cos(step), 2) / (8 * weight)), 3e-3);
    EXPECT_NEAR(kept, 1 / (1 + std::pow(step, 4) / (8 * weight)), 0.012);
  }
}

}  // namespace
}  // namespace vspring::fit_test
