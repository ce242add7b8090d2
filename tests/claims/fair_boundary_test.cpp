// What fairing the boundary first and then the surface (§4.5) is claimed to do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/fairness_of.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_boundary_test {
namespace {

using namespace support;

constexpr double half_angle = 50;

/// A cap of the unit sphere, its rim disturbed except at every sixth node, which is held.
struct DisturbedCap {
  PolygonMesh cap = generate::cap({.nodes = 217, .radius = 1, .half_angle = half_angle});
  PolygonMesh mesh = cap;
  Constraints constraints{cap.node_count()};
  std::set<Index> held;

  DisturbedCap() {
    const PolygonMesh noisy = generate::add_noise(cap, 0.03, 3);
    std::vector<Vector3> positions = noisy.positions();
    const auto rim = boundary_loops(cap).at(0);
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const auto node = static_cast<std::size_t>(rim[k]);
      constraints.fix_normal(rim[k], cap.position(rim[k]));
      if (k % 6 == 0) {
        constraints.fix_position(rim[k], cap.position(rim[k]));
        held.insert(rim[k]);
      } else {
        positions[node] = cap.position(rim[k]) + Vector3(0.02, 0.05, -0.03) * std::sin(17.0 * static_cast<double>(k));
      }
    }
    mesh.set_positions(std::move(positions));
  }
};

FairOptions boundary_first() {
  FairOptions options;
  // So that nodes of the rim come back to the places that their normals are of.
  options.distribution = Distribution::even;
  options.fair_boundary = EquilibriumMethod{.tolerance = 1e-12, .max_iterations = 20000};
  options.method = *options.fair_boundary;
  return options;
}

TEST(FairBoundary, ADisturbedRimBecomesTheCircleAndTheSurfaceTheSphere) {
  const DisturbedCap disturbed;
  ASSERT_GT(distance_from_unit_sphere(disturbed.mesh.positions()), 0.04);
  const FairResult result = fair(disturbed.mesh, disturbed.constraints, boundary_first());
  ASSERT_EQ(result.report.outcome, Outcome::converged);
  const double height = std::cos(half_angle * M_PI / 180);
  const auto rim = boundary_loops(disturbed.cap).at(0);
  for (const Index i : rim) {
    const Vector3& position = result.positions[static_cast<std::size_t>(i)];
    EXPECT_NEAR(position.z(), height, 1e-10);
    EXPECT_NEAR(position.head<2>().norm(), std::sin(half_angle * M_PI / 180), 1e-10);
  }
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  for (const Index i : disturbed.held)
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], disturbed.cap.position(i));
}

TEST(FairBoundary, ReportsTheWholeWayAndTheBoundarysOwn) {
  const DisturbedCap disturbed;
  const FairResult result = fair(disturbed.mesh, disturbed.constraints, boundary_first());
  EXPECT_DOUBLE_EQ(result.report.greatest_move, greatest_distance(result.positions, disturbed.mesh.positions()));
  EXPECT_EQ(result.report.fixed_positions, static_cast<Index>(disturbed.held.size()));
  EXPECT_EQ(result.report.moving_nodes, disturbed.mesh.node_count() - static_cast<Index>(disturbed.held.size()));
  ASSERT_TRUE(result.report.boundary);
  EXPECT_EQ(result.report.boundary->outcome, Outcome::converged);
  const auto [before, after] = fairness_of(boundary_curve(disturbed.mesh), disturbed.constraints, result.positions);
  EXPECT_LT(after.vspring_energy, before.vspring_energy);
}

TEST(FairBoundary, TheBoundaryGoesToItsEquilibriumWhateverTheMethodOfTheSurface) {
  const DisturbedCap disturbed;
  FairOptions options = boundary_first();
  options.method = SweepMethod{.max_iterations = 1};
  const FairReport report = fair(disturbed.mesh, disturbed.constraints, options).report;
  EXPECT_EQ(report.method, Method::sweep);
  ASSERT_TRUE(report.boundary);
  EXPECT_EQ(report.boundary->method, Method::equilibrium);
  EXPECT_LE(report.boundary->expected_error.value_or(1), std::get<EquilibriumMethod>(*options.fair_boundary).tolerance);
}

TEST(FairBoundary, StrengthGoesThatShareOfTheWholeWay) {
  const DisturbedCap disturbed;
  FairOptions options = boundary_first();
  const FairResult whole = fair(disturbed.mesh, disturbed.constraints, options);
  options.strength = 0.25;
  const FairResult part = fair(disturbed.mesh, disturbed.constraints, options);
  for (Index i = 0; i < disturbed.mesh.node_count(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vector3 expected = disturbed.mesh.position(i) + 0.25 * (whole.positions[n] - disturbed.mesh.position(i));
    EXPECT_LT((part.positions[n] - expected).norm(), 1e-15);
  }
}

TEST(FairBoundary, OnPolygonsOfEveryKind) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh patch = generate::sphere_patch({.columns = 8, .rows = 8, .faces = faces}, 1, 40);
    const PolygonMesh mesh = generate::add_noise(patch, 0.02, 5);
    Constraints constraints(mesh.node_count());
    const auto rim = boundary_loops(mesh).at(0);
    for (std::size_t k = 0; k < rim.size(); k += 3) constraints.fix_position(rim[k], patch.position(rim[k]));
    const FairResult result = fair(mesh, constraints, boundary_first());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    const auto [before, after] = fairness_of(mesh, constraints, result.positions);
    EXPECT_LT(after.rms_turn, 0.8 * before.rms_turn);
    const auto [boundary_before, boundary_after] = fairness_of(boundary_curve(mesh), constraints, result.positions);
    EXPECT_LT(boundary_after.rms_turn, boundary_before.rms_turn);
  }
}

TEST(FairBoundary, ARegionAtTheBoundaryGoesOnSmoothlyOutside) {
  const PolygonMesh cap = generate::cap({.nodes = 469, .radius = 1, .half_angle = half_angle});
  const Vector3 centre(std::sin(half_angle * M_PI / 180), 0, std::cos(half_angle * M_PI / 180));
  std::vector<Index> region;
  std::vector<Vector3> positions = cap.positions();
  for (Index i = 0; i < cap.node_count(); ++i) {
    const double distance = (cap.position(i) - centre).norm();
    if (distance > 0.4) continue;
    region.push_back(i);
    positions[static_cast<std::size_t>(i)] += 0.3 * (0.4 - distance) * Vector3(1, 1, 1);
  }
  PolygonMesh mesh = cap;
  mesh.set_positions(std::move(positions));
  Constraints constraints(mesh.node_count());
  const auto rim = boundary_loops(cap).at(0);
  for (const Index i : rim) constraints.fix_normal(i, cap.position(i));
  restrict_to_region(constraints, boundary_curve(mesh), region);
  restrict_to_region(constraints, mesh, region);
  const FairResult result = fair(mesh, constraints, boundary_first());
  ASSERT_EQ(result.report.outcome, Outcome::converged);
  // Tangents at the rim are exact on a circle; normals from outside are of second order.
  for (const Index i : rim) EXPECT_NEAR(result.positions[static_cast<std::size_t>(i)].z(), centre.z(), 1e-10);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-3);
}

TEST(FairBoundary, RefusesLoopsThatNothingHolds) {
  const PolygonMesh cap = generate::cap({.nodes = 127, .radius = 1, .half_angle = half_angle});
  try {
    (void)fair(cap, Constraints(cap.node_count()), boundary_first());
    FAIL() << "nothing was held";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unusable_constraint);
    EXPECT_NE(std::string(error.what()).find("nothing holds the closed curve through node"), std::string::npos);
  }
}

}  // namespace
}  // namespace vspring::fair_boundary_test
