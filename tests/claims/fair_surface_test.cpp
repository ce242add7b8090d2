// What fairing a surface by the paper's iteration is claimed to do.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "support/fairness_of.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_surface_test {
namespace {

using namespace support;

using generate::Faces;

FairOptions to_the_end() { return {.method = SweepMethod{.step_tolerance = 1e-13, .max_iterations = 20000}}; }

PolygonMesh noisy_annulus() {
  const PolygonMesh annulus = generate::annulus({.nodes = 553, .boundary_nodes = 121});
  return generate::add_noise(annulus, 0.02, 7);
}

TEST(FairSurface, APerturbedCapReturnsToTheSphere) {
  for (const Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh cap = generate::sphere_patch({.columns = 8, .rows = 8, .faces = faces, .jitter = 0.3}, 1, 50);
    const PolygonMesh perturbed = generate::add_noise(cap, 0.05, 11);
    ASSERT_GT(distance_from_unit_sphere(perturbed.positions()), 0.02);
    const FairResult result = fair(perturbed, held_boundary(cap, radial), to_the_end());
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  }
}

TEST(FairSurface, AFlatDiscBecomesTheCapThatItsRimAsksFor) {
  const PolygonMesh cap = generate::cap({.nodes = 127, .radius = 1, .half_angle = 60});
  const FairResult result = fair(pressed(cap, 0.5), held_boundary(cap, radial), to_the_end());
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  EXPECT_NEAR(result.report.greatest_move, 0.5, 0.1);
}

TEST(FairSurface, ABumpOnASphereFairedAsARegionGoes) {
  for (const Faces faces : every_kind) {
    for (const int cells : {12, 20}) {
      SCOPED_TRACE(static_cast<int>(faces) * 1000 + cells);
      const PolygonMesh sphere =
          generate::sphere_patch({.columns = cells, .rows = cells, .faces = faces, .jitter = 0.3}, 1, 90);
      std::vector<Index> region;
      std::vector<Vector3> bumped = sphere.positions();
      for (Index i = 0; i < sphere.node_count(); ++i) {
        const double from_pole = (sphere.position(i) - Vector3(0, 0, 1)).norm();
        if (from_pole > 0.45) continue;
        region.push_back(i);
        bumped[static_cast<std::size_t>(i)] *= 1 + 0.1 * std::exp(-20 * from_pole * from_pole);
      }
      const PolygonMesh mesh = with_positions(sphere, bumped);
      Constraints constraints(mesh.node_count());
      restrict_to_region(constraints, mesh, region);
      const FairResult result = fair(mesh, constraints, to_the_end());
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-8);
    }
  }
}

TEST(FairSurface, FairingAFairShapeAgainChangesNothing) {
  const PolygonMesh annulus = generate::annulus({.nodes = 300});
  const Constraints constraints = held_boundary(annulus, [](const Vector3&) { return Vector3(0, 0, 1); });
  const FairResult once = fair(annulus, constraints, to_the_end());
  ASSERT_EQ(once.report.outcome, Outcome::converged);
  const FairResult twice = fair(with_positions(annulus, once.positions), constraints, to_the_end());
  EXPECT_LT(greatest_distance(once.positions, twice.positions), 1e-11);
  EXPECT_GT(greatest_distance(once.positions, annulus.positions()), 1e-2);
}

TEST(FairSurface, MotionAndScalingCommuteWithFairing) {
  const PolygonMesh mesh = noisy_annulus();
  const FairOptions options = {.method = SweepMethod{.max_iterations = 30}};
  const Normal up = [](const Vector3&) { return Vector3(0, 0, 1); };
  const FairResult plain = fair(mesh, held_boundary(mesh, up), options);
  for (const double scale : {1.0, 1e-30, 3e7, 1e60}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3(1, -2, 3).normalized()).toRotationMatrix();
    const Vector3 shift = scale * Vector3(5, -3, 2);
    const auto moved = [&](const std::vector<Vector3>& positions) {
      std::vector<Vector3> result;
      result.reserve(positions.size());
      for (const Vector3& position : positions) result.emplace_back(scale * (turn * position) + shift);
      return result;
    };
    const PolygonMesh there = with_positions(mesh, moved(mesh.positions()));
    const Normal up_there = [&](const Vector3&) { return Vector3(turn * Vector3(0, 0, 1)); };
    const FairResult result = fair(there, held_boundary(there, up_there), options);
    EXPECT_LT(greatest_distance(result.positions, moved(plain.positions)) / scale, 1e-11) << "scale " << scale;
    EXPECT_NEAR(result.report.greatest_move / scale, plain.report.greatest_move, 1e-11);
  }
}

TEST(FairSurface, RenumberingCommutesWithFairingAtTheEquilibrium) {
  const PolygonMesh mesh = generate::add_noise(generate::annulus({.nodes = 200}), 0.02, 5);
  const auto shuffled = generate::shuffle(mesh, 9);
  const Normal up = [](const Vector3&) { return Vector3(0, 0, 1); };
  const FairResult plain = fair(mesh, held_boundary(mesh, up), to_the_end());
  const FairResult other = fair(shuffled.mesh, held_boundary(shuffled.mesh, up), to_the_end());
  std::vector<Vector3> expected(plain.positions.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    expected[static_cast<std::size_t>(shuffled.new_number[i])] = plain.positions[i];
  EXPECT_LT(greatest_distance(other.positions, expected), 1e-9);
}

TEST(FairSurface, FixedNodesComeOutBitForBit) {
  const PolygonMesh mesh = noisy_annulus();
  Constraints constraints = held_boundary(mesh);
  constraints.fix_position(200, {0.1 + 0.2, 1.0 / 3, 0.7});
  const FairResult result = fair(mesh, constraints);
  Index fixed = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!constraints.position_fixed(i)) continue;
    ++fixed;
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], constraints.position(i));
  }
  EXPECT_EQ(fixed, 122);
  EXPECT_EQ(result.report.fixed_positions, 122);
}

TEST(FairSurface, ThreadsGiveTheSameBits) {
  const PolygonMesh mesh = generate::add_noise(generate::cap({.nodes = 3000, .half_angle = 80}), 0.02, 3);
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    const FairOptions options = {.method = EquilibriumMethod{.max_iterations = 40}};
    return fair(mesh, held_boundary(mesh, radial), options, context);
  };
  const FairResult one = run(1);
  const FairResult two = run(2);
  EXPECT_EQ(two.report.threads, 2);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.report.history, two.report.history);
  Context context;
  context.threads = 2;
  const Constraints held = held_boundary(mesh, radial);
  EXPECT_EQ(measure(mesh, &held).vspring_energy, measure(mesh, &held, context).vspring_energy);
}

TEST(FairSurface, StrengthGoesPartOfTheWay) {
  const PolygonMesh mesh = noisy_annulus();
  const Constraints constraints = held_boundary(mesh);
  const FairResult whole = fair(mesh, constraints);
  FairOptions options;
  options.strength = 0.25;
  const FairResult quarter = fair(mesh, constraints, options);
  for (std::size_t i = 0; i < whole.positions.size(); ++i) {
    const Vector3 expected = mesh.positions()[i] + 0.25 * (whole.positions[i] - mesh.positions()[i]);
    EXPECT_LT((quarter.positions[i] - expected).norm(), 1e-14);
  }
  options.strength = 0;
  EXPECT_EQ(fair(mesh, constraints, options).positions, mesh.positions());
}

TEST(FairSurface, TellsHowItWentAndHowFarNodesMoved) {
  const PolygonMesh mesh = noisy_annulus();
  const Constraints constraints = held_boundary(mesh);
  Context context;
  double fraction = 0;
  int calls = 0;
  context.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, fraction);
    EXPECT_LE(progress.fraction, 1);
    fraction = progress.fraction;
    ++calls;
  };
  const FairResult result = fair(mesh, constraints, {}, context);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.nodes, 553);
  EXPECT_EQ(result.report.moving_nodes, 553 - 121);
  EXPECT_EQ(result.report.history.size(), static_cast<std::size_t>(result.report.iterations));
  EXPECT_LT(result.report.residual, 1e-3);
  EXPECT_DOUBLE_EQ(result.report.greatest_move, greatest_distance(result.positions, mesh.positions()));
  const auto [before, after] = fairness_of(mesh, constraints, result.positions);
  EXPECT_LT(after.vspring_energy, before.vspring_energy);

  const FairOptions options = {.method = EquilibriumMethod{.max_iterations = 3}};
  EXPECT_EQ(fair(mesh, constraints, options).report.outcome, Outcome::iteration_limit);
  context.cancel();
  fraction = 0;
  const FairResult cancelled = fair(mesh, constraints, {}, context);
  EXPECT_EQ(cancelled.report.outcome, Outcome::cancelled);
  EXPECT_EQ(cancelled.positions, mesh.positions());
}

TEST(FairSurface, ProgressGoesOnWhereASecondAttemptBegins) {
  // Between rims that may turn, sphere springs have no equilibrium.
  const PolygonMesh mesh = generate::pipe_blend();
  const Constraints constraints = held_boundary(mesh);
  Context context;
  double fraction = 0;
  context.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, fraction);
    fraction = progress.fraction;
  };
  const FairResult result = fair(mesh, constraints, {}, context);
  EXPECT_EQ(result.report.springs, Springs::edge);
  EXPECT_GT(fraction, 0.5);
  EXPECT_LE(fraction, 1);
}

TEST(FairSurface, WhatThePapersMethodsHadFoundWhenCancelledStays) {
  const PolygonMesh mesh = noisy_annulus();
  for (const FairingMethod& method :
       {FairingMethod(SweepMethod{.step_tolerance = 1e-12}), FairingMethod(MultigridMethod{.step_tolerance = 1e-12})}) {
    Context context;
    context.on_progress = [&](const Progress& progress) {
      if (progress.iteration > 3) context.cancel();
    };
    const FairResult result = fair(mesh, held_boundary(mesh), {.method = method}, context);
    EXPECT_EQ(result.report.outcome, Outcome::cancelled);
    EXPECT_GT(result.report.greatest_move, 1e-4);
    EXPECT_NE(result.positions, mesh.positions());
  }
}

TEST(FairSurface, RefusesOptionsOutOfRange) {
  const PolygonMesh mesh = noisy_annulus();
  const Constraints constraints = held_boundary(mesh);
  const double nan = std::nan("");
  for (const FairingMethod& method :
       {FairingMethod(EquilibriumMethod{.tolerance = 0}), FairingMethod(EquilibriumMethod{.max_iterations = -1}),
        FairingMethod(MultigridMethod{.step_tolerance = nan}), FairingMethod(MultigridMethod{.max_iterations = -1}),
        FairingMethod(MultigridMethod{.levels = 0}), FairingMethod(MultigridMethod{.pre_smoothing = -1}),
        FairingMethod(SweepMethod{.step_tolerance = 0}), FairingMethod(SweepMethod{.max_iterations = -1})})
    EXPECT_THROW((void)fair(mesh, constraints, {.method = method}), Error);
  EXPECT_THROW((void)fair(mesh, constraints, {.fair_boundary = EquilibriumMethod{.tolerance = nan}}), Error);
  EXPECT_THROW((void)fair(mesh, constraints, {.strength = 1.5}), Error);
  EXPECT_THROW((void)fair(mesh, Constraints(3)), Error);
}

}  // namespace
}  // namespace vspring::fair_surface_test
