// Fits told what they are to do by lengths: what is smoothed away, how far points may lie.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "support/fairness_of.hpp"
#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_tolerance_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

FitOptions smoothing(double length, double tolerance = 1e-8) {
  FitOptions options;
  options.criterion = SmoothingLength{length};
  options.fair.method = equilibrium_alone(tolerance);
  return options;
}

FitOptions within(double distance) {
  FitOptions options;
  options.criterion = Within{distance};
  return options;
}

FitOptions with_rms(double distance) {
  FitOptions options;
  options.criterion = RootMeanSquare{distance};
  return options;
}

std::vector<Vector3> line(int edges) { return straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges)); }

/// By what share a wave of small height is kept; `dense` points to an edge.
double gain_on_a_curve(int edges, int dense, int waves, double length) {
  const double height = 0.02 / edges;
  ScatteredPoints points;
  for (int j = 1; j < edges * dense; ++j) {
    const double x = static_cast<double>(j) / (edges * dense);
    points.positions.emplace_back(x, height * std::sin(2 * pi * waves * x), 0);
  }
  const FitResult result = fit(PolygonCurve(line(edges)), held_ends(line(edges)), points, smoothing(length));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  double sum = 0;
  for (const Vector3& p : result.positions) sum += p.y() * std::sin(2 * pi * waves * p.x());
  return 2 * sum / edges / height;
}

double gain_on_a_surface(int cells, int dense, double length) {
  const auto wave = [](const Vector3& p) { return std::sin(2 * pi * p.x()) * std::sin(2 * pi * p.y()); };
  const double height = 1e-3 / cells;
  const PolygonMesh plane = generate::plane({.columns = cells, .rows = cells, .faces = generate::Faces::quads});
  const PolygonMesh sites = generate::plane({.columns = cells * dense, .rows = cells * dense});
  ScatteredPoints points;
  for (const Vector3& p : sites.positions()) {
    if (p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1) points.positions.emplace_back(p.x(), p.y(), height * wave(p));
  }
  const FitResult result = fit(plane, held_boundary(plane), points, smoothing(length));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  double product = 0;
  double square = 0;
  for (const Vector3& p : result.positions) {
    product += p.z() * wave(p);
    square += wave(p) * wave(p);
  }
  return product / square / height;
}

TEST(FitSmoothingLength, MeansTheSameAtEveryResolutionAndDensity) {
  for (const int waves : {1, 2, 4}) {
    const double expected = 1 / (1 + std::pow(0.08 * 2 * pi * waves, 4));
    for (const int edges : {40, 80, 160}) {
      for (const int dense : {1, 3}) EXPECT_NEAR(gain_on_a_curve(edges, dense, waves, 0.08), expected, 0.005);
    }
  }
  const double expected = 1 / (1 + std::pow(0.12 * 2 * pi * std::sqrt(2), 4));
  for (const int cells : {12, 24, 48}) {
    for (const int dense : {1, 3}) EXPECT_NEAR(gain_on_a_surface(cells, dense, 0.12), expected, 0.02);
  }
}

TEST(FitSmoothingLength, IsThePapersWeightWhereEveryNodeHasOnePoint) {
  std::vector<Vector3> nodes = line(50);
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i].y() = 1e-3 * std::sin(40 * nodes[i].x());
  const PolygonCurve curve(nodes);
  const std::vector<Vector3> inner(nodes.begin() + 1, nodes.end() - 1);
  FitOptions by_weight = smoothing(1);
  by_weight.criterion = Weight{std::pow(0.02 / 0.05, 4) / 8};
  const FitResult weighted = fit(curve, held_ends(nodes), {.positions = inner}, by_weight);
  const FitResult smoothed = fit(curve, held_ends(nodes), {.positions = inner}, smoothing(0.05));
  EXPECT_LT(greatest_distance(weighted.positions, smoothed.positions), 3e-6);
  EXPECT_GT(greatest_distance(weighted.positions, nodes), 1e-4);
  ASSERT_TRUE(smoothed.report.smoothing_length.has_value());
  EXPECT_EQ(*smoothed.report.smoothing_length, 0.05);
  EXPECT_FALSE(weighted.report.smoothing_length.has_value());
}

TEST(FitSmoothingLength, FewPointsMeanTheSameOnFinerMeshes) {
  const ScatteredPoints points{.positions = {{0.21, 0.05, 0}, {0.52, -0.03, 0}, {0.77, 0.06, 0}}};
  const auto middle = [&](int edges) {
    const FitResult result = fit(PolygonCurve(line(edges)), held_ends(line(edges)), points, smoothing(0.1));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    return result.positions[static_cast<std::size_t>(edges / 4)].y();
  };
  const double exact = middle(640);
  EXPECT_NEAR(exact, 0.0348, 0.0005);
  EXPECT_NEAR(middle(160), exact, 2e-4);
  EXPECT_NEAR(middle(40), exact, 5e-4);
}

TEST(FitSmoothingLength, GoesWithTheUnits) {
  std::vector<Vector3> nodes = line(60);
  for (std::size_t i = 1; i < 60; ++i) nodes[i].y() = 0.05 * std::sin(9 * nodes[i].x());
  Motion motion;
  motion.scale = 1e6;
  const std::vector<Vector3> moved = motion.points(nodes);
  const FitResult plain = fit(PolygonCurve(nodes), held_ends(nodes), {.positions = nodes}, smoothing(0.1));
  const FitResult large = fit(PolygonCurve(moved), held_ends(moved), {.positions = moved}, smoothing(0.1e6));
  EXPECT_LT(greatest_distance(motion.points(plain.positions), large.positions), 1e-5 * motion.scale);
}

TEST(FitSmoothingLength, HoldsForEveryLengthAndMethod) {
  const PolygonMesh plane = generate::plane({.columns = 8, .rows = 8, .faces = generate::Faces::mixed});
  const PolygonMesh bumpy = generate::add_noise(plane, 0.02, 3);
  const ScatteredPoints points{.positions = bumpy.positions()};
  for (const double length : {1e-200, 1e-6, 1.0, 1e6, 1e200}) {
    const FitResult result = fit(bumpy, held_boundary(plane), points, smoothing(length, 1e-5));
    for (const Vector3& p : result.positions) EXPECT_TRUE(p.allFinite());
  }
  FitOptions sweeps = smoothing(0.2);
  sweeps.fair.distribution = Distribution::smooth;
  sweeps.fair.method = SweepMethod{.step_tolerance = 1e-7};
  const FitResult swept = fit(bumpy, held_boundary(plane), points, sweeps);
  const FitResult solved = fit(bumpy, held_boundary(plane), points, smoothing(0.2));
  EXPECT_LT(greatest_distance(swept.positions, solved.positions), 1e-4);
}

struct NoisyWave {
  Constraints held;
  std::vector<Vector3> nodes;
  PolygonCurve curve;

  explicit NoisyWave(int edges, double noise = 0.002) : held(0) {
    for (const Vector3& p : line(edges)) nodes.emplace_back(p.x(), 0.1 * std::sin(2 * pi * p.x()), 0);
    held = held_ends(nodes);
    nodes = noisy(nodes, held, noise, 1, true);
    curve = PolygonCurve(nodes);
  }
  [[nodiscard]] FitResult fit(const FitOptions& options) const {
    return vspring::fit(curve, held, {.positions = nodes}, options);
  }
  /// What a curve has least of within a tolerance.
  [[nodiscard]] double unfairness(const FitResult& fitted) const {
    PolygonCurve moved = curve;
    moved.set_positions(fitted.positions);
    return measure_curve(moved).curvature_variation;
  }
};

/// A plane and 2,000 points in waves over it, with noise.
struct NoisyPlane {
  PolygonMesh plane = generate::plane({.columns = 16, .rows = 16, .faces = generate::Faces::quads});
  ScatteredPoints points;

  NoisyPlane() {
    Draw draw(3);
    for (int j = 0; j < 2000; ++j) {
      const double x = draw.uniform(0.02, 0.98);
      const double y = draw.uniform(0.02, 0.98);
      const double z = 0.1 * std::sin(pi * x) * std::sin(2 * pi * y) + draw.uniform(-0.005, 0.005);
      points.positions.emplace_back(x, y, z);
    }
  }
  [[nodiscard]] FitResult fit(const FitOptions& options) const {
    return vspring::fit(plane, held_boundary(plane), points, options);
  }
  /// The root mean square turn, which is what even edges bend by.
  [[nodiscard]] double unfairness(const FitResult& fitted) const {
    return fairness_of(plane, held_boundary(plane), fitted.positions).after.rms_turn;
  }
};

/// The least of 30 uniform weights within a distance.
template <typename Specimen>
double best_of_weights(const Specimen& specimen, double distance) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 30; ++k) {
    FitOptions options;
    options.criterion = Weight{std::pow(10, -8 + 0.3 * k)};
    options.fair.method = EquilibriumMethod{.max_iterations = 60};
    const FitResult result = specimen.fit(options);
    if (result.report.after.all.greatest <= distance) best = std::min(best, specimen.unfairness(result));
  }
  return best;
}

TEST(FitWithin, EveryPointIsWithinAndNoUniformWeightIsFairer) {
  const NoisyWave wave(60);
  for (const double tolerance : {0.01, 0.003, 0.002}) {
    SCOPED_TRACE(tolerance);
    const FitResult result = wave.fit(within(tolerance));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    PolygonCurve fitted = wave.curve;
    fitted.set_positions(result.positions);
    EXPECT_LE(distance(wave.nodes, fitted).greatest, tolerance);
    EXPECT_GT(distance(wave.nodes, fitted).greatest, 0.9 * tolerance);
    EXPECT_LT(wave.unfairness(result), best_of_weights(wave, tolerance));
  }
  const NoisyPlane plane;
  const FitResult result = plane.fit(within(0.01));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(distance(plane.points.positions, with_positions(plane.plane, result.positions)).greatest, 0.01);
  EXPECT_LT(plane.unfairness(result), best_of_weights(plane, 0.01));
}

TEST(FitWithin, NamesThePointsAtTheDistance) {
  const NoisyWave wave(60);
  for (const double tolerance : {0.01, 0.003}) {
    const FitResult result = wave.fit(within(tolerance));
    const std::vector<Index>& active = result.report.active_points;
    EXPECT_GE(active.size(), 2U);
    for (std::size_t j = 0; j < wave.nodes.size(); ++j)
      EXPECT_EQ(std::count(active.begin(), active.end(), static_cast<Index>(j)),
                result.distances[j] > 0.99 * tolerance ? 1 : 0);
  }
}

TEST(FitWithin, PullsHardWhereNoUniformWeightIsWithin) {
  // Where nodes are few for the noise, only some points may count.
  const NoisyPlane plane;
  const FitResult result = plane.fit(within(0.006));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.after.all.greatest, 0.006);
  EXPECT_EQ(best_of_weights(plane, 0.006), std::numeric_limits<double>::infinity());
}

TEST(FitWithin, AnInputWithinStaysWithin) {
  // Between rims that are free to turn springs make of a tube something else.
  constexpr int columns = 25;
  const PolygonMesh tube = generate::tube({.columns = columns, .rows = 27}, 1, 4);
  ScatteredPoints points;
  for (int k = 0; k < 2000; ++k) {
    const double around = k * (std::sqrt(5) - 1) * std::numbers::pi;
    points.positions.emplace_back(std::cos(around), std::sin(around), 0.1 + 3.8 * k / 2000);
  }
  Constraints held(tube.node_count());
  fix_boundary_positions(held, tube);
  const double tolerance = 1.2 * (1 - std::cos(std::numbers::pi / columns));
  const FitResult result = fit(tube, held, points, within(tolerance));
  EXPECT_LE(result.report.before.all.greatest, tolerance);
  EXPECT_LE(result.report.after.all.greatest, tolerance);
}

TEST(FitWithin, AWideToleranceLeavesPlainFairing) {
  const NoisyWave wave(60);
  const FitResult result = wave.fit(within(0.2));
  EXPECT_EQ(result.positions, fair(wave.curve, wave.held).positions);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.pulling_points, 0);
  EXPECT_FALSE(result.report.smoothing_length.has_value());
  EXPECT_EQ(wave.fit(with_rms(0.2)).positions, result.positions);
}

TEST(FitWithin, EndsWhereItIsNotWorthMore) {
  // Noise of many edges, along the curve as well, crumples it.
  const FitResult result = NoisyWave(900, 0.01).fit(within(0.006));
  const FairReport& report = result.report.fair;
  EXPECT_NE(report.outcome, Outcome::converged);
  EXPECT_GE(report.work, report.most_work) << "or it would show nothing";
  // The last run of many may go beyond.
  EXPECT_LE(report.work, 1.05 * report.most_work);
}

TEST(FitWithin, SaysWhereNoShapeIs) {
  const NoisyWave wave(60);
  ScatteredPoints points{.positions = wave.nodes};
  // Two that no curve is near to at once.
  points.positions.emplace_back(0.5, 0.03, 0);
  points.positions.emplace_back(0.5, -0.03, 0);
  for (const FitOptions& options : {within(0.01), with_rms(1e-4)}) {
    const FitResult result = fit(wave.curve, wave.held, points, options);
    EXPECT_FALSE(result.report.fair.usable());
    ASSERT_FALSE(result.report.fair.warnings.empty());
    const WarningCode code = result.report.fair.warnings.back().code;
    EXPECT_TRUE(code == WarningCode::outside_tolerance || code == WarningCode::worse_than_input);
    for (const Vector3& p : result.positions) EXPECT_TRUE(p.allFinite());
  }
}

TEST(FitWithin, GivesTheSameBitsOnAnyNumberOfThreads) {
  const NoisyPlane plane;
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fit(plane.plane, held_boundary(plane.plane), plane.points, within(0.01), context).positions;
  };
  const std::vector<Vector3> one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(4));
}

TEST(FitWithin, EndsWhenCancelled) {
  const NoisyPlane plane;
  Context context;
  context.on_progress = [&](const Progress& /*progress*/) { context.cancel(); };
  const FitResult result = fit(plane.plane, held_boundary(plane.plane), plane.points, within(0.01), context);
  EXPECT_EQ(result.report.fair.outcome, Outcome::cancelled);
  EXPECT_EQ(result.positions, plane.plane.positions());
}

TEST(FitRms, IsUsedUpAndLeavesAFairCurve) {
  const NoisyWave wave(120, 0.001);
  const double exact = measure_curve(NoisyWave(120, 0).curve).curvature_variation;
  EXPECT_GT(measure_curve(wave.curve).curvature_variation, 1000 * exact);
  for (const double tolerance : {0.0005, 0.001, 0.004}) {
    SCOPED_TRACE(tolerance);
    const FitResult result = wave.fit(with_rms(tolerance));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LE(result.report.after.all.rms, tolerance);
    EXPECT_GT(result.report.after.all.rms, 0.97 * tolerance);
    EXPECT_LT(wave.unfairness(result), 1.5 * exact);
  }
}

TEST(FitRms, WorksForAClosedShapeThatOnlyPointsHold) {
  const PolygonMesh ball = closed_sphere(4);
  Draw draw(3);
  std::vector<Vector3> rough = ball.positions();
  for (Vector3& p : rough) p *= 1 + draw.uniform(-0.03, 0.03);
  FitOptions options = with_rms(0.02);
  options.fair.distribution = Distribution::keep;
  const FitResult result =
      fit(with_positions(ball, rough), Constraints(ball.node_count()), {.positions = rough}, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.after.all.rms, 0.02);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 0.03);
}

TEST(FitOutliers, AreLeftOut) {
  const NoisyWave wave(100, 0.0005);
  ScatteredPoints points{.positions = wave.nodes};
  for (const std::size_t j : {20U, 45U, 46U, 70U}) points.positions[j].y() += 0.3;
  const auto off = [&](const FitResult& result) {
    double greatest = 0;
    for (const Vector3& p : result.positions)
      greatest = std::max(greatest, std::abs(p.y() - 0.1 * std::sin(2 * pi * p.x())));
    return greatest;
  };
  for (FitOptions options : {smoothing(0.05, 1e-6), with_rms(0.001), within(0.003)}) {
    options.outliers = 0.04;
    const FitResult result = fit(wave.curve, wave.held, points, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(result.report.outliers, 4);
    EXPECT_LT(off(result), 0.005);
    EXPECT_LT(result.report.after.all.greatest, 0.005);
    // Less the two at held ends.
    EXPECT_EQ(result.report.after.all.count, 95);
    EXPECT_EQ(result.distances[static_cast<std::size_t>(result.report.after.all.node)],
              result.report.after.all.greatest);
    EXPECT_NEAR(result.distances[45], 0.3, 0.05);
  }
  FitOptions pulled = smoothing(0.05, 1e-6);
  pulled.fair.accept_worse = true;
  EXPECT_GT(off(fit(wave.curve, wave.held, points, pulled)), 0.02);
}

TEST(FitTolerances, RefuseWhatCannotBeMeant) {
  const NoisyWave wave(10);
  const auto refusal = [&](const std::function<void(FitOptions&)>& change) -> std::string {
    FitOptions options;
    change(options);
    try {
      (void)wave.fit(options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal([](FitOptions& o) { o.criterion = SmoothingLength{0}; }).find("smoothing length"),
            std::string::npos);
  EXPECT_NE(refusal([](FitOptions& o) { o.criterion = Within{-1}; }).find("within"), std::string::npos);
  EXPECT_NE(refusal([](FitOptions& o) { o.criterion = RootMeanSquare{std::nan("")}; }).find("rms"), std::string::npos);
  EXPECT_NE(refusal([](FitOptions& o) { o.criterion = Noise{0}; }).find("noise"), std::string::npos);
  EXPECT_NE(refusal([](FitOptions& o) { o.criterion = Weight{-1}; }).find("weight"), std::string::npos);
  EXPECT_NE(refusal([](FitOptions& o) { o.outliers = 1; }).find("outliers"), std::string::npos);
  EXPECT_NE(refusal([](FitOptions& o) {
              o.criterion = Within{1};
              o.fair.method = SweepMethod{};
            }).find("sweep"),
            std::string::npos);
}

/// A torus with noise in its nodes, and a scan of it with noise: at three places for each node.
struct ScannedTorus {
  explicit ScannedTorus(std::uint64_t seed, generate::Faces faces)
      : smooth(generate::torus({.columns = 24, .rows = 16, .faces = faces})),
        mesh(generate::add_noise(smooth, 0.06, seed)) {
    Draw draw(seed);
    for (int turn = 0; turn < 3 * smooth.node_count(); ++turn) {
      const double u = draw.uniform(0, 2 * pi);
      const double v = draw.uniform(0, 2 * pi);
      const Vector3 out(std::cos(u), std::sin(u), 0);
      scan.positions.push_back(out + 0.4 * (std::cos(v) * out + std::sin(v) * Vector3::UnitZ()) + draw.in_cube(0.03));
    }
  }

  PolygonMesh smooth;
  PolygonMesh mesh;
  ScatteredPoints scan;
};

// Most of their springs find no equilibrium.
TEST(FitWithin, EndsOnClosedShapesThatOnlyPointsHold) {
  constexpr double distance = 0.06;
  for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::quads}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const ScannedTorus torus(seed, faces);
      const FitResult result = fit(torus.mesh, Constraints(torus.mesh.node_count()), torus.scan, within(distance));
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_LE(result.report.after.all.greatest, distance);
      // About as little as the torus itself, which is nearly within the distance; its noise bends it by far more.
      const double bent = measure_surface(with_positions(torus.mesh, result.positions)).bending_energy;
      EXPECT_LT(bent, 1.02 * measure_surface(torus.smooth).bending_energy);
      EXPECT_GT(measure_surface(torus.mesh).bending_energy, 1.7 * bent);
    }
  }
}

TEST(FitWithin, LeavesOutliersOfClosedShapesOut) {
  ScannedTorus torus(1, generate::Faces::triangles);
  std::vector<Index> far_off;
  for (std::size_t j = 50; j < torus.scan.positions.size(); j += 150) {
    Vector3& point = torus.scan.positions[j];
    const Vector3 axis = Vector3(point.x(), point.y(), 0).normalized();
    point += point - axis;
    far_off.push_back(static_cast<Index>(j));
  }
  FitOptions options = within(0.06);
  options.outliers = 0.01;
  const FitResult result = fit(torus.mesh, Constraints(torus.mesh.node_count()), torus.scan, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  const std::vector<Index>& outlying = result.report.outlying_points;
  EXPECT_TRUE(std::includes(outlying.begin(), outlying.end(), far_off.begin(), far_off.end()));
  EXPECT_EQ(result.report.outside_points, 0);
}

TEST(FitToRootMeanSquare, EndsOnClosedShapesThatOnlyPointsHold) {
  constexpr double rms = 0.017;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ScannedTorus torus(seed, generate::Faces::triangles);
    const FitResult result = fit(torus.mesh, Constraints(torus.mesh.node_count()), torus.scan, with_rms(rms));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LE(result.report.after.all.rms, rms);
    EXPECT_GT(result.report.after.all.rms, 0.98 * rms);
  }
}

}  // namespace
}  // namespace vspring::fit_tolerance_test
