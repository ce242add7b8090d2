// What shapes are fitted to: points on known ones give them back, noise averages out.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/fits.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_accuracy_test {
namespace {

using namespace support;

/// Root mean square of z over the nodes inside, away from what is held.
double inner_rms(const std::vector<Vector3>& positions) {
  double sum = 0;
  double count = 0;
  for (const Vector3& p : positions) {
    if (p.x() < 0.15 || p.x() > 0.85 || std::abs(p.y() - 0.5) > 0.35) continue;
    sum += p.z() * p.z();
    count += 1;
  }
  return std::sqrt(sum / count);
}

TEST(FitAccuracy, NoiseIsReducedAsAveragingPredicts) {
  Draw draw(4);
  const auto rough = [&](std::vector<Vector3> nodes, const Constraints& held, double height) {
    for (Index i = 0; i < held.node_count(); ++i) {
      if (!held.position_fixed(i)) nodes[static_cast<std::size_t>(i)].z() = draw.uniform(-height, height);
    }
    return nodes;
  };
  // Waves of angular frequency ω keep 1/(1 + (λω)⁴): of the variance 0.265 ℓ/λ is left on a curve, a/(16 λ²) on a
  // surface of a to a node.
  const double sd = 1e-4 / std::sqrt(3.0);
  const std::vector<Vector3> line = straight({0, 0.5, 0}, {1, 0.5, 0}, places(Spacing::even, 2000));
  const Constraints ends = held_ends(line);
  const PolygonCurve curve(rough(line, ends, 1e-4));
  for (const double weight : {1e-3, 1e-6}) {
    const FitResult result = fit(curve, ends, {.positions = curve.positions()}, to_equilibrium(weight, 1e-8));
    const double factor = std::sqrt(0.265 * std::pow(8 * weight, 0.25));
    EXPECT_NEAR(inner_rms(result.positions) / (sd * factor), 1, 0.3) << weight;
  }
  const PolygonMesh plane = generate::plane({.columns = 50, .rows = 50, .faces = generate::Faces::quads});
  const Constraints held = held_boundary(plane);
  const PolygonMesh mesh = with_positions(plane, rough(plane.positions(), held, 1e-4));
  for (const double weight : {1e-2, 1e-4}) {
    const FitResult result = fit(mesh, held, {.positions = mesh.positions()}, to_equilibrium(weight, 1e-7));
    const double factor = std::sqrt(std::sqrt(16 * weight) / 16);
    EXPECT_NEAR(inner_rms(result.positions) / (sd * factor), 1, 0.3) << weight;
  }
}

/// Springs see how even the spacing is.
FitOptions evenly(FitOptions options) {
  options.fair.distribution = Distribution::even;
  return options;
}

/// The order in which points on a shape, as dense as nodes, give it back on finer meshes.
TEST(FitAccuracy, PointsOnACylinderGiveItBackWithTheOrderOfFairing) {
  const auto error = [](int cells) {
    const PolygonMesh exact = generate::cylinder_patch({.columns = cells, .rows = cells}, 1, 120, 2);
    const PolygonMesh dense = generate::cylinder_patch({.columns = 3 * cells, .rows = 3 * cells}, 1, 120, 2);
    const Constraints held = held_boundary(exact, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); });
    const FitResult result =
        fit(generate::add_noise(exact, 0.02, 3), held, {.positions = dense.positions()}, evenly(to_equilibrium(0.01)));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    double greatest = 0;
    for (const Vector3& p : result.positions) greatest = std::max(greatest, std::abs(p.head<2>().norm() - 1));
    return greatest;
  };
  const double coarse = error(15);
  const double fine = error(30);
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(order(coarse, fine), 1.7);
}

TEST(FitAccuracy, PointsOnASphereGiveItBackWithTheOrderOfFairing) {
  const double coarse =
      distance_from_unit_sphere(flat_cap(300, on_the_sphere(3000)).fit(to_equilibrium(0.01)).positions);
  const double fine =
      distance_from_unit_sphere(flat_cap(1200, on_the_sphere(12000)).fit(to_equilibrium(0.01)).positions);
  EXPECT_LT(fine, 5e-4);
  EXPECT_GT(order(coarse, fine), 1.5);
}

TEST(FitAccuracy, PointsOnAClothoidGiveItBackWithItsOrder) {
  const reference::Clothoid clothoid = reference::hermite_clothoid({0, 0}, 0.9, {1, 0}, -0.3);
  const auto error = [&](int edges) {
    const std::vector<Vector3> exact = sampled(clothoid, places(Spacing::even, edges));
    const std::vector<Vector3> dense = sampled(clothoid, places(Spacing::even, 4 * edges));
    const Constraints held = held_ends(exact, heading(clothoid.angle), heading(clothoid.angle_at(clothoid.length)));
    const FitResult result = fit(PolygonCurve(noisy(exact, held, 0.01, 1, true)), held, {.positions = dense},
                                 evenly(to_equilibrium(0.01, 1e-9)));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    return distance_from(clothoid, result.positions);
  };
  const double coarse = error(40);
  const double fine = error(80);
  EXPECT_LT(fine, 1e-5);
  EXPECT_GT(order(coarse, fine), 1.9);
}

}  // namespace
}  // namespace vspring::fit_accuracy_test
