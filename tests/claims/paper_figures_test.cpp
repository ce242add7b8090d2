// The shapes of the paper's Figs. 9, 10 and 12: large noise, blends between boundaries with normals, a pentagon fitted
// to points.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "support/fairness_of.hpp"
#include "support/fits.hpp"
#include "support/specimens.hpp"
#include "vspring/vspring.hpp"

namespace vspring::paper_figures_test {
namespace {

using namespace support;
using generate::Side;

FairOptions by(const FairingMethod& method, PseudoNormals normals = PseudoNormals::link) {
  FairOptions options;
  options.method = method;
  options.pseudo_normals = normals;
  return options;
}

/// Fig. 9: the mesh of Fig. 8 under random noise about as large as its edges; both boundaries held with normals.
struct NoisyAnnulus {
  PolygonMesh clean = generate::annulus({.nodes = 553, .boundary_nodes = 121});
  PolygonMesh noisy = generate::add_noise(clean, 0.08, 3);
  Constraints held = held_boundary(clean, [](const Vector3&) { return Vector3(0, 0, 1); });
};

TEST(PaperFigures, NineBFiveSweepsTakeLargeNoiseOut) {
  const NoisyAnnulus shape;
  for (const PseudoNormals normals : {PseudoNormals::average, PseudoNormals::link}) {
    const FairResult result = fair(shape.noisy, shape.held, by(SweepMethod{.max_iterations = 5}, normals));
    EXPECT_EQ(result.report.iterations, 5);
    const auto [before, after] = fairness_of(shape.noisy, shape.held, result.positions);
    EXPECT_LT(after.rms_turn, before.rms_turn / 5);
    Eigen::AlignedBox<double, 3> box;
    for (const Vector3& position : shape.noisy.positions()) box.extend(position);
    for (const Vector3& position : result.positions) EXPECT_TRUE(box.contains(position));
  }
}

TEST(PaperFigures, NineCEndsInTheShapeThatComesWithoutNoise) {
  const NoisyAnnulus shape;
  for (const PseudoNormals normals : {PseudoNormals::average, PseudoNormals::link}) {
    const FairOptions options = by(MultigridMethod{.step_tolerance = 1e-6, .levels = 6}, normals);
    const FairResult rough = fair(shape.noisy, shape.held, options);
    const FairResult clean = fair(shape.clean, shape.held, options);
    EXPECT_EQ(rough.report.outcome, Outcome::converged);
    EXPECT_LT(greatest_distance(rough.positions, clean.positions), 0.005);
    EXPECT_GT(greatest_distance(shape.clean.positions(), clean.positions), 0.05);
    const auto [before, after] = fairness_of(shape.clean, shape.held, clean.positions);
    EXPECT_LT(after.vspring_energy, 0.2 * before.vspring_energy);
    EXPECT_LT(after.greatest_turn, 0.5 * before.greatest_turn);
  }
}

/// How far from its mirror image a shape is, across the planes y = 0 and z = 0.
double asymmetry(const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& sides : {Vector3(1, -1, 1), Vector3(1, 1, -1)}) {
    for (const Vector3& p : positions) {
      double nearest = 1e300;
      for (const Vector3& q : positions) nearest = std::min(nearest, (q - p.cwiseProduct(sides)).norm());
      greatest = std::max(greatest, nearest);
    }
  }
  return greatest;
}

TEST(PaperFigures, TenPipesMeetTheirBoundariesWithTheirNormals) {
  const PolygonMesh pipes = generate::pipe_blend({.pipes = {Side::plus_x, Side::plus_z, Side::minus_z}, .cells = 5});
  const FairOptions options = by(MultigridMethod{.step_tolerance = 1e-4, .levels = 6});
  const Constraints held = clamped_boundary(pipes);
  const FairResult result = fair(pipes, held, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  for (Index i = 0; i < pipes.node_count(); ++i) {
    if (!held.position_fixed(i)) continue;
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], held.position(i));
  }
  const PolygonMesh blend = with_positions(pipes, result.positions);
  const SurfaceFigures before = measure_surface(pipes, &held);
  const SurfaceFigures after = measure_surface(blend, &held);
  EXPECT_LT(asymmetry(result.positions), 0.02);
  EXPECT_NEAR(before.greatest_turn, 90, 1e-6);
  EXPECT_LT(after.greatest_turn, 30);
  EXPECT_LT(after.vspring_energy, 0.01 * before.vspring_energy);
  ASSERT_TRUE(after.normal_error.has_value());
  // With positions alone the blend leaves the pipes at an angle.
  const FairResult loose = fair(pipes, held_boundary(pipes), options);
  const SurfaceFigures kinked = measure_surface(with_positions(pipes, loose.positions), &held);
  EXPECT_LT(*after.normal_error, 2);
  EXPECT_GT(*kinked.normal_error, 20);
}

TEST(PaperFigures, TwelveAPentagonAmongQuadsIsFittedToPoints) {
  const PolygonMesh cap = polygon_cap(5, 8);
  const PolygonMesh flat = flattened(cap, 60, 0);
  const double noise = 0.02;
  const FitResult result = fit(flat, held_boundary(flat, radial), on_the_sphere(4000, noise), by_sweeps(0.01, 1e-6));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_GT(distance_from_unit_sphere(flat.positions()), 0.3);
  EXPECT_LT(distance_from_unit_sphere(result.positions), noise / 4);
  EXPECT_LT(distance_from_unit_sphere({result.positions.begin(), result.positions.begin() + 5}), noise / 4);
}

}  // namespace
}  // namespace vspring::paper_figures_test
