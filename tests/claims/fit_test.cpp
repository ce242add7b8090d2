// What fitting to scattered points is claimed to do.

#include "vspring/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

FitOptions with_weight(double weight, double step_tolerance = 1e-8, int iterations = 20000) {
  FitOptions options;
  options.weight = weight;
  options.fair.method = Method::sweep;
  options.fair.step_tolerance = step_tolerance;
  options.fair.max_iterations = iterations;
  return options;
}

/// A cap of the unit sphere pressed flat; its rim is held, with the normals of the sphere.
struct FlatCap {
  PolygonMesh cap = generate::cap({.nodes = 217, .radius = 1, .half_angle = 60});
  PolygonMesh flat = flattened(cap, 60, 0);
  Constraints held = held_boundary(flat, radial);
};

/// Points at random on that cap, spread evenly.
ScatteredPoints on_the_sphere(int count, double radius = 1, double noise = 0) {
  Draw draw(5);
  ScatteredPoints points;
  while (static_cast<int>(points.positions.size()) < count) {
    const Vector3 direction = draw.in_cube(1);
    if (direction.norm() > 1 || direction.z() < 0.5 * direction.norm() || direction.norm() < 0.01) continue;
    points.positions.push_back((radius + draw.uniform(-noise, noise)) * direction.normalized());
  }
  return points;
}

PolygonCurve segment(int edges) { return PolygonCurve(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges))); }

PolygonCurve circle(int nodes, double radius) {
  std::vector<Vector3> positions;
  for (int i = 0; i < nodes; ++i) positions.push_back(radius * heading(2 * pi * i / nodes));
  return PolygonCurve(std::move(positions), true);
}

std::string refusal(const ScatteredPoints& points, const FitOptions& options = {}) {
  const PolygonCurve curve = segment(10);
  try {
    (void)fit(curve, held_ends(curve.positions()), points, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    return error.what();
  }
  return "";
}

TEST(Fit, PointsOnASpherePullAFlatCapOntoIt) {
  const FlatCap start;
  const FitResult result = fit(start.flat, start.held, on_the_sphere(2000), with_weight(0.1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_GT(result.report.before.all.greatest, 0.4);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 2e-3);
  // What is left is mostly the distance of the sphere from its chords.
  EXPECT_LT(result.report.after.all.greatest, 0.01);
  EXPECT_GT(result.report.pulled_nodes, 150);
}

TEST(Fit, ManyNoisyPointsAverageOut) {
  const FlatCap start;
  const FitResult result = fit(start.flat, start.held, on_the_sphere(20000, 1, 0.05), with_weight(0.001, 1e-7));
  EXPECT_LT(distance_from_unit_sphere(result.positions), 5e-3);
}

TEST(Fit, PointsOnAPlaneFlattenAMeshOfEveryKind) {
  for (const auto faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12, .faces = faces});
    const PolygonMesh bumpy = generate::add_noise(plane, 0.03, 3);
    Constraints held(plane.node_count());
    fix_boundary_positions(held, plane);
    const FitResult result = fit(bumpy, held, {.positions = plane.positions()}, with_weight(1, 1e-9));
    for (const Vector3& position : result.positions) EXPECT_NEAR(position.z(), 0, 1e-6);
  }
}

TEST(Fit, PointsOnACirclePullAClosedCurveThatNothingElseHolds) {
  const PolygonCurve small = circle(40, 0.8);
  const ScatteredPoints points{.positions = circle(97, 1).positions()};
  const FitResult result = fit(small, Constraints(40), points, with_weight(0.05));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-3);
  EXPECT_THROW((void)fair(small, Constraints(40)), Error);
}

TEST(Fit, AClosedSurfaceMayBeHeldByPointsAlone) {
  PolygonMesh ball = projected(generate::genus({.holes = 0}));
  std::vector<Vector3> small = ball.positions();
  for (Vector3& position : small) position *= 0.9;
  const FitResult result = fit(with_positions(ball, small), Constraints(ball.node_count()),
                               {.positions = ball.positions()}, with_weight(0.1, 1e-3));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 0.01);
}

TEST(Fit, WithoutWeightItIsPlainFairingToTheBit) {
  const FlatCap start;
  FitOptions options = with_weight(0, 1e-4);
  options.fair.method = Method::sweep;
  const FairResult plain = fair(start.flat, start.held, options.fair);
  EXPECT_EQ(fit(start.flat, start.held, on_the_sphere(100), options).positions, plain.positions);
  ScatteredPoints unweighted = on_the_sphere(100);
  unweighted.weights.assign(100, 0);
  options.weight = 1;
  const FitResult result = fit(start.flat, start.held, unweighted, options);
  EXPECT_EQ(result.positions, plain.positions);
  EXPECT_EQ(result.report.pulling_points, 0);

  const PolygonCurve bent(noisy(segment(30).positions(), held_ends(segment(30).positions()), 0.01, 1, true));
  const Constraints ends = held_ends(bent.positions());
  EXPECT_EQ(fit(bent, ends, on_the_sphere(10), with_weight(0)).positions, fair(bent, ends,
                                                                               [] {
                                                                                 FairOptions sweep =
                                                                                     with_weight(0).fair;
                                                                                 sweep.method = Method::sweep;
                                                                                 return sweep;
                                                                               }())
                                                                              .positions);
}

TEST(Fit, AHugeWeightInterpolatesOnePointForEveryNode) {
  const PolygonCurve curve = segment(40);
  ScatteredPoints points;
  for (const Vector3& p : curve.positions()) points.positions.emplace_back(p.x(), 0.05 * std::sin(2 * pi * p.x()), 0);
  const FitResult on_curve = fit(curve, held_ends(curve.positions()), points, with_weight(1e6));
  EXPECT_EQ(on_curve.report.fair.outcome, Outcome::converged);
  EXPECT_GT(on_curve.report.before.all.greatest, 0.049);
  EXPECT_LT(on_curve.report.after.all.greatest, 2e-4);

  const FlatCap start;
  const FitResult on_surface =
      fit(start.flat, start.held, {.positions = start.cap.positions()}, with_weight(1e6, 1e-6));
  // Nodes slide between the points, which are then as far as chords are from the sphere.
  EXPECT_LT(on_surface.report.after.all.rms, on_surface.report.before.all.rms / 100);
}

TEST(Fit, FixedNodesStayToTheBit) {
  FlatCap start;
  start.held.fix_position(30, start.flat.position(30) + Vector3(0, 0, 0.1));
  const FitResult result = fit(start.flat, start.held, on_the_sphere(2000), with_weight(0.1));
  for (Index i = 0; i < start.flat.node_count(); ++i) {
    if (!start.held.position_fixed(i)) continue;
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], start.held.position(i));
  }
}

TEST(Fit, GivenNormalsHoldWhilePointsPull) {
  const FlatCap start;
  const ScatteredPoints pulling{.positions = {{0, 0, 1.1}}};
  const auto lean = [&](const Constraints& held) {
    const PolygonMesh fitted = with_positions(start.flat, fit(start.flat, held, pulling, with_weight(0.1)).positions);
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
  const PolygonCurve curve = segment(60);
  const Constraints held = held_ends(curve.positions(), heading(0.5), heading(-0.5));
  const ScatteredPoints points{.positions = {{0.5, 0.2, 0}}};
  const FitResult result = fit(curve, held, points, with_weight(0.01, 1e-9, 200000));
  const Vector3 start = (result.positions[1] - result.positions[0]).normalized();
  EXPECT_NEAR(std::atan2(start.y(), start.x()), 0.5, 0.03);
  EXPECT_LT(result.report.after.all.greatest, result.report.before.all.greatest / 5);
}

TEST(Fit, OnePointDrawsTheNearestNodeAndAllOthersFollow) {
  const PolygonCurve curve = segment(20);
  const FitResult result =
      fit(curve, held_ends(curve.positions()), {.positions = {{0.5, 0.1, 0}}}, with_weight(1, 1e-10, 100000));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.pulling_points, 1);
  EXPECT_EQ(result.report.pulled_nodes, 1);
  EXPECT_LT(result.report.after.all.greatest, 1e-3);
  for (std::size_t i = 1; i < 20; ++i) EXPECT_GT(result.positions[i].y(), 0);
}

TEST(Fit, ThousandsOfPointsOnOneNodePullLikeTheirAverage) {
  const PolygonCurve curve = segment(20);
  ScatteredPoints points;
  points.positions.assign(5000, {0.5, 0.1, 0});
  const FitOptions options = with_weight(0.1, 1e-10, 100000);
  const FitResult many = fit(curve, held_ends(curve.positions()), points, options);
  EXPECT_EQ(many.report.most_points, 5000);
  const FitResult one = fit(curve, held_ends(curve.positions()), {.positions = {{0.5, 0.1, 0}}}, options);
  EXPECT_LT(greatest_distance(many.positions, one.positions), 1e-10);
}

TEST(Fit, APointMayBeFarAway) {
  const PolygonCurve curve = segment(20);
  for (const double away : {100.0, 1e12, 1e40}) {
    SCOPED_TRACE(away);
    const FitResult result =
        fit(curve, held_ends(curve.positions()), {.positions = {{0.5, away, 0}}}, with_weight(0.01, 1e-3, 200));
    for (const Vector3& position : result.positions) EXPECT_TRUE(position.allFinite());
    EXPECT_TRUE(std::isfinite(result.report.after.all.rms));
  }
  EXPECT_NE(refusal({.positions = {{0, 0, 0}, {0, 1e60, 0}}}).find("point 1 "), std::string::npos);
}

TEST(Fit, NodesWithoutPointsAreFairBetweenThoseThatHaveSome) {
  const FlatCap start;
  const FitResult result = fit(start.flat, start.held, on_the_sphere(30), with_weight(0.1, 1e-8, 50000));
  EXPECT_LE(result.report.pulled_nodes, 30);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 0.02);
}

TEST(Fit, PointsNearestToWhatStaysPullAtNothing) {
  const PolygonMesh plane = generate::plane({.columns = 20, .rows = 20});
  Constraints held(plane.node_count());
  const std::vector<Index> region = select_region(plane.positions(), "sphere:0.25,0.25,0,0.15");
  restrict_to_region(held, plane, region);
  const ScatteredPoints points{.positions = {{0.9, 0.9, 0.1}}};
  const FitResult away = fit(plane, held, points, with_weight(1));
  EXPECT_EQ(away.report.pulling_points, 0);
  EXPECT_LT(greatest_distance(away.positions, plane.positions()), 1e-12);
  const FitResult near = fit(plane, held, {.positions = {{0.25, 0.25, 0.05}}}, with_weight(1));
  EXPECT_EQ(near.report.pulling_points, 1);
  EXPECT_GT(near.report.fair.greatest_move, 0.03);
}

TEST(Fit, TiesGoWithTheNodes) {
  // All points begin at the end node that is nearest to them, and are then passed on along the curve.
  const PolygonCurve curve = segment(40);
  ScatteredPoints points;
  for (int j = 0; j <= 100; ++j) points.positions.emplace_back(Vector3(0.5, 0, 0) + 0.5 * heading(pi * j / 100));
  const FitResult result = fit(curve, held_ends(curve.positions()), points, with_weight(0.05, 1e-7, 50000));
  EXPECT_LT(result.report.after.percentile99, 0.01);
  EXPECT_GT(result.report.pulled_nodes, 35);
}

TEST(Fit, HeavierPointsCountMore) {
  const PolygonCurve curve = segment(20);
  const auto height = [&](double upper, double lower) {
    const ScatteredPoints points{.positions = {{0.5, 0.1, 0}, {0.5, -0.1, 0}}, .weights = {upper, lower}};
    return fit(curve, held_ends(curve.positions()), points, with_weight(0.1, 1e-9, 100000)).positions[10].y();
  };
  EXPECT_NEAR(height(1, 1), 0, 1e-9);
  EXPECT_GT(height(3, 1), 0.01);
  EXPECT_NEAR(height(3, 1), -height(1, 3), 1e-6);
}

TEST(Fit, PointsLiftAPlanarCurveOutOfItsPlane) {
  for (const NormalPlane plane : {NormalPlane::full, NormalPlane::principal}) {
    const PolygonCurve curve = segment(20);
    FitOptions options = with_weight(1, 1e-7);
    options.fair.curve.normal_plane = plane;
    const FitResult result = fit(curve, held_ends(curve.positions()), {.positions = {{0.5, 0, 0.1}}}, options);
    EXPECT_NEAR(result.positions[10].z(), 0.1, 0.01);
  }
}

TEST(Fit, ScaleAndPlaceOfTheWholeMakeNoDifference) {
  const PolygonCurve curve = segment(30);
  Draw draw(3);
  ScatteredPoints points;
  for (int j = 0; j < 50; ++j) points.positions.emplace_back(draw.uniform(0, 1), draw.uniform(0, 0.1), 0);
  const FitOptions options = with_weight(0.05, 1e-6);
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
  const ScatteredPoints points = on_the_sphere(9000, 1, 0.01);
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fit(flat, held_boundary(flat), points, with_weight(0.1, 1e-12, 60), context);
  };
  const FitResult one = run(1);
  for (const int threads : {2, 3}) {
    const FitResult other = run(threads);
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.distances, other.distances);
  }
}

TEST(Fit, SaysHowFarPointsLie) {
  const PolygonCurve curve = segment(4);
  ScatteredPoints points;
  for (int j = 1; j <= 100; ++j) points.positions.emplace_back(0.5, 0.001 * j, 0);
  const FitResult result = fit(curve, held_ends(curve.positions()), points, with_weight(0));
  for (const PointDistances& distances : {result.report.before, result.report.after}) {
    EXPECT_NEAR(distances.all.greatest, 0.1, 1e-15);
    EXPECT_EQ(distances.all.node, 99);
    EXPECT_EQ(distances.all.count, 100);
    EXPECT_NEAR(distances.all.rms, 0.001 * std::sqrt(338350.0 / 100), 1e-15);
    EXPECT_NEAR(distances.median, 0.05, 1e-15);
    EXPECT_NEAR(distances.percentile90, 0.09, 1e-15);
    EXPECT_NEAR(distances.percentile99, 0.099, 1e-15);
  }
  ASSERT_EQ(result.distances.size(), 100U);
  EXPECT_NEAR(result.distances[16], 0.017, 1e-15);
}

TEST(Fit, DeviationsAtNodesAreThoseOfTheFurthestOfTheirPoints) {
  const std::vector<Vector3> nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Vector3> points = {{0.1, 0, 1}, {0.2, 0, 3}, {-5, 0, 2}, {2.2, 0, 0.5}};
  const std::vector<double> distances = {1, 3, 2, 0.5};
  EXPECT_EQ(node_deviations(nodes, points, distances, {}), (std::vector<double>{3, 0, 0.5}));
  const std::vector<double> odd = {1, 3, 2, std::numeric_limits<double>::quiet_NaN()};
  for (const auto& wrong : {std::vector<double>{1, 2, 3}, odd})
    EXPECT_THROW((void)node_deviations(nodes, points, wrong, {}), Error);
}

TEST(Fit, RefusalsNameThePoint) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ScatteredPoints points;
  EXPECT_NE(refusal(points).find("no points"), std::string::npos);
  points.positions.assign(30, {0.5, 0, 0});
  points.weights.assign(29, 1);
  EXPECT_NE(refusal(points).find("29 weights"), std::string::npos);
  points.weights.assign(30, 1);
  points.weights[12] = -0.5;
  EXPECT_NE(refusal(points).find("the weight of point 12"), std::string::npos);
  points.weights[12] = nan;
  EXPECT_NE(refusal(points).find("the weight of point 12"), std::string::npos);
  points.weights.clear();
  points.positions[17].y() = nan;
  EXPECT_NE(refusal(points).find("point 17 is not finite"), std::string::npos);
  points.positions[17].y() = 0;
  EXPECT_NE(refusal(points, with_weight(-1)).find("weight"), std::string::npos);
  FitOptions options;
  options.fair.method = Method::multigrid;
  EXPECT_NE(refusal(points, options).find("multigrid"), std::string::npos);
  options = {};
  options.fair.fair_boundary = true;
  EXPECT_NE(refusal(points, options).find("boundary"), std::string::npos);
}

TEST(Fit, EndsAndBoundariesMustBeHeldAllTheSame) {
  const PolygonCurve curve = segment(10);
  EXPECT_THROW((void)fit(curve, Constraints(11), {.positions = curve.positions()}), Error);
  const PolygonMesh plane = generate::plane({.columns = 4, .rows = 4});
  EXPECT_THROW((void)fit(plane, Constraints(plane.node_count()), {.positions = plane.positions()}), Error);
  EXPECT_THROW((void)fit(plane, Constraints(3), {.positions = plane.positions()}), Error);
}

TEST(Fit, EndsWithTheShapeSoFarWhenCancelled) {
  const FlatCap start;
  Context context;
  context.on_progress = [&](const Progress& /*progress*/) { context.cancel(); };
  const FitResult result = fit(start.flat, start.held, on_the_sphere(1000), with_weight(0.1, 1e-12), context);
  EXPECT_EQ(result.report.fair.outcome, Outcome::cancelled);
  EXPECT_EQ(result.positions, start.flat.positions());
  EXPECT_EQ(result.report.after.all.count, 1000);
}

/// Fig. 11: the nodes of a wavy curve are its points. By what share a wave of small height is kept.
double gain(double weight, int waves, int edges) {
  const double height = 0.02 / edges;
  std::vector<Vector3> nodes = segment(edges).positions();
  for (Vector3& node : nodes) node.y() = height * std::sin(2 * pi * waves * node.x());
  FitOptions options = with_weight(weight);
  options.fair.method = Method::equilibrium;
  options.fair.tolerance = 1e-9;
  options.fair.max_iterations = {};
  const FitResult result = fit(PolygonCurve(nodes), held_ends(nodes), {.positions = nodes}, options);
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
}  // namespace vspring
