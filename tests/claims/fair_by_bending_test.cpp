// What fairing by least bending is claimed to do.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/specimens.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_by_bending_test {
namespace {

using namespace support;

using generate::Faces;

/// A band of the torus of least bending, its axis z.
Vector3 torus_chart(double along, double around, double lift) {
  const double up = 150 * degree * (along - 0.5);
  const double angle = 2 * std::numbers::pi * around;
  const double radius = std::numbers::sqrt2 + (1 + lift) * std::cos(up);
  return {radius * std::cos(angle), radius * std::sin(angle), (1 + lift) * std::sin(up)};
}

Vector3 from_pipe(const Vector3& p) {
  const Vector3 around = std::numbers::sqrt2 * Vector3(p.x(), p.y(), 0).normalized();
  return p - around;
}

double distance_from_torus(const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& p : positions) greatest = std::max(greatest, std::abs(from_pipe(p).norm() - 1));
  return greatest;
}

FairOptions by(FairBy fair_by, double tolerance = 1e-8) {
  FairOptions options;
  options.fair_by = fair_by;
  options.method = EquilibriumMethod{.tolerance = tolerance};
  return options;
}

Specimen band(int rows, Faces faces, double jitter = 0) {
  return on_chart("", torus_chart, true, {.columns = 4 * rows, .rows = rows, .faces = faces}, {.jitter = jitter},
                  from_pipe);
}

TEST(FairByBending, ABandOfTheTorusOfLeastBendingComesBack) {
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    SCOPED_TRACE(name_of(faces));
    const auto error = [&](int rows, FairBy fair_by) {
      const Specimen start = band(rows, faces, 0.3);
      const FairResult result = fair(start.start, start.constraints, by(fair_by));
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.report.springs, Springs::sphere);
      EXPECT_EQ(result.report.fair_by, fair_by);
      return distance_from_torus(result.positions);
    };
    const double of_bending = error(16, FairBy::bending);
    EXPECT_LT(of_bending, 0.4 * error(8, FairBy::bending));
    EXPECT_GT(error(16, FairBy::curvature), 10 * of_bending);
  }
}

TEST(FairByBending, ATubeBulgesToBendLess) {
  const PolygonMesh tube = generate::tube({.columns = 32, .rows = 24}, 1, 3);
  const auto faired = [&](FairBy fair_by) {
    return fair(tube, held_boundary(tube, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); }), by(fair_by));
  };
  const auto bending = [&](const FairResult& result) {
    return measure_surface(with_positions(tube, result.positions)).bending_energy;
  };
  const FairResult of_bending = faired(FairBy::bending);
  EXPECT_EQ(of_bending.report.outcome, Outcome::converged);
  EXPECT_LT(bending(of_bending), 0.98 * bending(faired(FairBy::curvature)));
  for (const Vector3& p : of_bending.positions) EXPECT_LT(p.head<2>().norm(), 1.12);
  EXPECT_GT(of_bending.positions[std::size_t{12} * 32].head<2>().norm(), 1.08);
}

TEST(FairByBending, ATubeBetweenRimsThatAreFreeToTurnBulgesAsItsEquationSays) {
  // By shooting from the middle: ΔH + 2H(H² − K) = 0, not curved across the rims. A cylinder has next to no V-Spring
  // energy, which says nothing against a shape that bends less.
  for (const auto& [height, radius] : {std::pair(3.000, 1.356), std::pair(4.620, 2.000), std::pair(5.694, 2.500)}) {
    SCOPED_TRACE(height);
    const PolygonMesh tube = generate::tube({.columns = 24, .rows = 16, .faces = Faces::quads}, 1, height);
    const FairResult result = fair(tube, held_boundary(tube), by(FairBy::bending));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.fair_by, FairBy::bending);
    EXPECT_NEAR(result.positions[std::size_t{8} * 24].head<2>().norm(), radius, 0.002 * radius);
  }
}

TEST(FairByBending, WhereSpringsFindNothingStepsThatBendItLessDo) {
  // A ball of many times the radius of its rims.
  const PolygonMesh tube = generate::tube({.columns = 16, .rows = 24}, 1, 24);
  const FairResult result = fair(tube, held_boundary(tube), by(FairBy::bending, 1e-5));
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair_by, FairBy::bending);
  EXPECT_TRUE(result.report.warnings.empty());
  EXPECT_LT(measure_surface(with_positions(tube, result.positions)).bending_energy, 40);
  EXPECT_GT(measure_surface(tube).bending_energy, 130);
}

TEST(FairByBending, IsForSphereSprings) {
  // A slope that is given at a node inside is for edge springs.
  const PolygonMesh plane = generate::plane({.columns = 8, .rows = 8});
  Constraints tilted = held_boundary(plane);
  tilted.fix_position(4 * 9 + 4, plane.position(4 * 9 + 4));
  tilted.fix_normal(4 * 9 + 4, {0.2, 0, 1});
  const auto faired = [&](Springs springs, FairBy fair_by) {
    FairOptions options = by(fair_by, 1e-5);
    options.springs = springs;
    return fair(plane, tilted, options);
  };
  const FairResult result = faired(Springs::sphere, FairBy::bending);
  EXPECT_EQ(result.report.springs, Springs::edge);
  EXPECT_EQ(result.report.fair_by, FairBy::curvature);
  ASSERT_EQ(result.report.warnings.size(), 1U);
  EXPECT_NE(result.report.warnings[0].text.find("least bending"), std::string::npos);
  EXPECT_TRUE(faired(Springs::sphere, FairBy::curvature).report.warnings.empty());
  const FairResult of_edges = faired(Springs::edge, FairBy::bending);
  EXPECT_EQ(of_edges.positions, result.positions);
  EXPECT_TRUE(of_edges.report.warnings.empty());
}

TEST(FairByBending, ASessionKeepsToIt) {
  const Specimen start = band(12, Faces::triangles);
  Constraints constraints = start.constraints;
  FairingSession session(start.start, by(FairBy::bending));
  EXPECT_EQ(session.fair(constraints).report.fair_by, FairBy::bending);
  for (Index i = 0; i < start.start.node_count(); ++i) {
    if (constraints.position_fixed(i) && constraints.position(i).z() > 0)
      constraints.fix_position(i, constraints.position(i) + Vector3(0, 0, 0.05));
  }
  const FairResult next = session.fair(constraints);
  EXPECT_EQ(next.report.outcome, Outcome::converged);
  EXPECT_EQ(next.report.springs, Springs::sphere);
  EXPECT_EQ(next.report.fair_by, FairBy::bending);
  EXPECT_EQ(next.report.levels.size(), 1U);
  const FairResult afresh = fair(start.start, constraints, by(FairBy::bending));
  EXPECT_LT(node_distance(next.positions, afresh.positions).greatest, 1e-6);
  const FairResult of_curvature = fair(start.start, constraints, by(FairBy::curvature));
  EXPECT_GT(node_distance(next.positions, of_curvature.positions).greatest, 1e-3);
}

}  // namespace
}  // namespace vspring::fair_by_bending_test
