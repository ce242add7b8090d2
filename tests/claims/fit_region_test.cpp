// Fits of a part of a surface, or within a held rim: what is held cannot come nearer to its points, so these do not
// count.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_region_test {
namespace {

using namespace support;

/// Standard deviation in each coordinate, about.
constexpr double noise = 0.005;

/// A torus whose nodes are off by noise, of which a part may move.
struct Scan {
  PolygonMesh truth = generate::torus({.columns = 60, .rows = 30});
  PolygonMesh mesh = generate::add_noise(truth, 2.2 * noise, 5);
  Constraints held{mesh.node_count()};
  std::vector<Index> moving = select_region(truth.positions(), {SphereRegion{{1.4, 0, 0}, 0.45}});

  Scan() { restrict_to_region(held, mesh, moving); }

  [[nodiscard]] double rms_of_moving(const std::vector<double>& distances) const {
    double squares = 0;
    for (const Index i : moving) squares += std::pow(distances[static_cast<std::size_t>(i)], 2);
    return std::sqrt(squares / static_cast<double>(moving.size()));
  }
};

FitOptions by(FitCriterion criterion) {
  FitOptions options;
  options.criterion = std::move(criterion);
  return options;
}

bool warns_of(const FitResult& result, WarningCode code) {
  const auto& warnings = result.report.fair.warnings;
  return std::any_of(warnings.begin(), warnings.end(), [&](const Warning& one) { return one.code == code; });
}

TEST(FitRegion, TheRootMeanSquareIsThatOfTheNodesThatMove) {
  const Scan scan;
  ASSERT_LT(4 * scan.moving.size(), scan.mesh.positions().size());
  for (const Distribution distribution : {Distribution::keep, Distribution::even}) {
    FitOptions options = by(RootMeanSquare{noise});
    options.fair.distribution = distribution;
    const FitResult result = fit(scan.mesh, scan.held, {.positions = scan.mesh.positions()}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    const double rms = scan.rms_of_moving(result.distances);
    EXPECT_LE(rms, 1.001 * noise);
    EXPECT_GE(rms, 0.7 * noise);
    EXPECT_NEAR(result.report.after.all.rms, rms, 1e-9);
    EXPECT_EQ(result.report.after.all.count, static_cast<Index>(scan.moving.size()));
    EXPECT_EQ(result.report.at_held.count, scan.mesh.node_count() - static_cast<Index>(scan.moving.size()));
  }
}

/// A second scan of it, whose points lie beside the nodes.
ScatteredPoints points_of(const Scan& scan) {
  return {.positions = generate::add_noise(scan.truth, 2.2 * noise, 6).positions()};
}

TEST(FitRegion, PointsOfWhatIsHeldCountInNoTolerance) {
  const Scan scan;
  const ScatteredPoints points = points_of(scan);
  const double tolerance = 2.5 * noise;
  const FitResult result = fit(scan.mesh, scan.held, points, by(Within{tolerance}));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.outside_points, 0);
  EXPECT_GT(result.report.at_held.greatest, tolerance);
  EXPECT_TRUE(warns_of(result, WarningCode::points_at_held));
  for (const Index i : scan.moving) EXPECT_LE(result.distances[static_cast<std::size_t>(i)], tolerance);
  const FitResult by_rms = fit(scan.mesh, scan.held, points, by(RootMeanSquare{noise}));
  EXPECT_EQ(by_rms.report.fair.outcome, Outcome::converged);
  EXPECT_LE(scan.rms_of_moving(by_rms.distances), 1.1 * noise);
}

TEST(FitRegion, OutliersAreLookedForAmongPointsThatCount) {
  const Scan scan;
  ScatteredPoints points = points_of(scan);
  // Most of what is off is elsewhere, and further off.
  for (std::size_t j = 0; j < points.positions.size(); ++j) {
    if (points.positions[j].x() < 0) points.positions[j] *= 1.3;
  }
  const auto top = static_cast<std::size_t>(scan.moving.front());
  points.positions[top] *= 1.2;
  FitOptions options = by(Within{3 * noise});
  options.outliers = 1.5 / static_cast<double>(points.positions.size());
  const FitResult result = fit(scan.mesh, scan.held, points, options);
  EXPECT_EQ(result.report.outlying_points, std::vector<Index>{scan.moving.front()});
}

TEST(FitRegion, PointsBeyondAHeldRimDoNotKeepTheRestFromTheTolerance) {
  const PolygonMesh plane = generate::plane({.columns = 16, .rows = 16});
  const PolygonMesh bumpy = generate::add_noise(plane, 0.01, 3);
  std::mt19937 draw(4);
  std::uniform_real_distribution<double> place(0.05, 0.95);
  ScatteredPoints points;
  for (int j = 0; j < 400; ++j) points.positions.emplace_back(place(draw), place(draw), 0.02);
  for (int j = 0; j < 5; ++j) points.positions.emplace_back(1.1, 0.1 + 0.2 * j, 0.02);
  PolygonMesh start = plane;
  std::vector<Vector3> positions = bumpy.positions();
  const Constraints rim = held_boundary(plane);
  for (Index i = 0; i < plane.node_count(); ++i) {
    if (rim.position_fixed(i)) positions[static_cast<std::size_t>(i)] = plane.position(i);
  }
  start.set_positions(std::move(positions));
  const FitResult result = fit(start, rim, points, by(Within{0.03}));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.at_held.count, 5);
  EXPECT_NEAR(result.report.at_held.greatest, std::hypot(0.1, 0.02), 1e-9);
  EXPECT_EQ(result.report.outside_points, 0);
}

TEST(FitRegion, WhereAllPointsLieAtWhatIsHeldAllCount) {
  const PolygonMesh plane = generate::plane({.columns = 8, .rows = 8});
  const ScatteredPoints points{.positions = {{1.5, 0.5, 0}, {-0.5, 0.5, 0}}};
  const FitResult result = fit(plane, held_boundary(plane), points, by(SmoothingLength{0.1}));
  EXPECT_EQ(result.report.after.all.count, 2);
  EXPECT_NEAR(result.report.after.all.greatest, 0.5, 1e-12);
  EXPECT_EQ(result.report.at_held.count, 0);
}

}  // namespace
}  // namespace vspring::fit_region_test
