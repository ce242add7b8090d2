// Half a shape by symmetry is fitted to points on both sides as the whole would be; a whole one comes out of a fit as
// its own mirror image, to the bit.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/curves.hpp"
#include "support/specimens.hpp"
#include "support/symmetry.hpp"

namespace vspring::symmetry_fit_test {
namespace {

using namespace support;
using generate::Faces;

/// Points on the unit sphere with noise, on both sides of the plane or on one.
ScatteredPoints scan(double noise, bool both) {
  Draw draw(11);
  ScatteredPoints points;
  for (int k = 0; k < 900; ++k) {
    const double x = draw.uniform(both ? -0.6 : 0, 0.6);
    const double y = draw.uniform(0, 1.2);
    const double square = x * x + y * y;
    points.positions.push_back((1 + draw.uniform(-noise, noise)) * Vector3(2 * x, 2 * y, 1 - square) / (1 + square));
  }
  return points;
}

TEST(SymmetryOfFits, HalfIsFittedToPointsOfOneSideOrBoth) {
  const PolygonMesh exact = sphere_part(Faces::quads, true);
  const Constraints rim = held_boundary(find_symmetry(exact, x_is_0).whole);
  const PolygonMesh start = disturbed(exact, rim, 0.02, x_is_0);
  const Symmetric<PolygonMesh> shape = find_symmetry(start, x_is_0);
  for (const bool both : {false, true}) {
    const ScatteredPoints points = scan(0.01, both);
    const FitResult result = fit(shape, rim, points, {.criterion = Within{0.02}});
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << both;
    EXPECT_EQ(result.report.points, 900);
    EXPECT_EQ(result.report.outside_points, 0);
    EXPECT_EQ(result.distances.size(), 900U);
    EXPECT_LE(result.report.after.all.greatest, 0.02);
    EXPECT_EQ(result.report.after.all.count, 900);
    EXPECT_GT(result.report.before.all.greatest, 0.02);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 0.02);
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
      if (shape.partner[i] == static_cast<Index>(i)) {
        EXPECT_EQ(result.positions[i].x(), 0);
      }
    }
  }
}

TEST(SymmetryOfFits, OwnNodesOfAHalfPullWithTheirMirrorImages) {
  const PolygonMesh exact = sphere_part(Faces::triangles, true, 14);
  const Constraints rim = held_boundary(find_symmetry(exact, x_is_0).whole);
  const PolygonMesh start = disturbed(exact, rim, 0.006, x_is_0);
  const Symmetric<PolygonMesh> shape = find_symmetry(start, x_is_0);
  const ScatteredPoints nodes{.positions = start.positions()};
  const FitOptions options[] = {
      {.criterion = Noise{0.006 / std::sqrt(3.0)}, .fair = {.distribution = Distribution::keep}},
      {.criterion = Within{0.012}, .fair = {.distribution = Distribution::keep}},
      {.criterion = RootMeanSquare{0.004}, .fair = {.distribution = Distribution::keep}},
      {.criterion = SmoothingLength{0.06}, .fair = {.distribution = Distribution::keep}}};
  for (const FitOptions& option : options) {
    const FitResult result = fit(shape, rim, nodes, option);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << option.criterion.index();
    EXPECT_EQ(result.report.points, start.node_count());
    EXPECT_EQ(result.report.shape.count, start.node_count());
    EXPECT_LT(distance_from_unit_sphere(result.positions), 0.5 * distance_from_unit_sphere(start.positions()))
        << option.criterion.index();
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
      if (shape.partner[i] == static_cast<Index>(i)) {
        EXPECT_EQ(result.positions[i].x(), 0);
      }
    }
  }
}

TEST(SymmetryOfFits, OwnNodesOfAWholeComeOutSymmetricToTheBit) {
  const PolygonMesh exact = sphere_part(Faces::quads, false);
  const PolygonMesh start = generate::add_noise(exact, 0.006, 3);
  const Symmetric<PolygonMesh> shape = find_symmetry(start, x_is_0);
  const Constraints rim = held_boundary(shape.whole);
  const ScatteredPoints nodes{.positions = start.positions()};
  const FitOptions options[] = {
      {.criterion = Noise{0.006 / std::sqrt(3.0)}, .fair = {.distribution = Distribution::keep}},
      {.criterion = Within{0.012}, .fair = {.distribution = Distribution::keep}},
      {.criterion = RootMeanSquare{0.004}, .fair = {.distribution = Distribution::keep}},
      {.criterion = Weight{0.01}, .fair = {.distribution = Distribution::keep}}};
  for (const FitOptions& option : options) {
    const FitResult result = fit(shape, rim, nodes, option);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << option.criterion.index();
    EXPECT_EQ(result.report.points, start.node_count());
    if (option.tolerance()) {
      const double left = option.within() ? result.report.after.all.greatest : result.report.after.all.rms;
      EXPECT_LE(left, *option.tolerance()) << option.criterion.index();
    }
    expect_mirror_images(shape, result.positions);
  }
}

TEST(SymmetryOfFits, OutliersAndFurthestPointsAreGivenOnes) {
  const PolygonMesh exact = sphere_part(Faces::quads, true);
  const Symmetric<PolygonMesh> shape = find_symmetry(exact, x_is_0);
  ScatteredPoints points = scan(0, false);
  points.positions[17] *= 1.3;
  const FitResult result = fit(shape, held_rim(shape), points, {.criterion = Weight{0.1}, .outliers = 1.0 / 900});
  EXPECT_EQ(result.report.outlying_points, std::vector<Index>({17}));
  EXPECT_EQ(result.report.outliers, 1);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-3);
}

TEST(SymmetryOfFits, HalfACurveIsFittedToItsNodes) {
  const PolygonCurve half = arc(0, 180, 0.02);
  const Symmetric<PolygonCurve> shape = find_symmetry(half, parse_plane("y"));
  const FitResult result =
      fit(shape, Constraints(half.node_count()), {.positions = half.positions()}, {.criterion = Within{0.03}});
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance_from_circle(result.positions), distance_from_circle(half.positions()));
  EXPECT_EQ(result.report.points, 41);
  EXPECT_EQ(result.report.outside_points, 0);
  EXPECT_EQ(result.positions.front().y(), 0);
  EXPECT_EQ(result.positions.back().y(), 0);
}

TEST(SymmetryOfFits, WholeCurveComesOutSymmetricToTheBit) {
  const PolygonCurve curve = arc(-130, 130, 0.03);
  const Symmetric<PolygonCurve> shape = find_symmetry(curve, parse_plane("y"));
  Constraints constraints(curve.node_count());
  for (const Index i : {0, 40}) hold_on_circle(constraints, curve, i);
  const FitResult result = fit(shape, constraints, {.positions = curve.positions()}, {.criterion = Within{0.06}});
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.after.all.greatest, 0.06);
  EXPECT_EQ(result.report.points, curve.node_count());
  expect_mirror_images(shape, result.positions);
}

}  // namespace
}  // namespace vspring::symmetry_fit_test
