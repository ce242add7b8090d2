#include "curve_fit/curve_fitter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vspring::curve_fitter_test {
namespace {

/// Two straight sides of length 1 at a right angle, 20 rows each, the ends held.
CurveFitTask corner() {
  CurveFitTask task;
  auto& chain = task.chains.emplace_back();
  for (int k = 0; k <= 40; ++k) {
    ChainNode& node = chain.nodes.emplace_back();
    node.place = k < 20 ? Vector3(k / 20.0, 0, 0) : Vector3(1, (k - 20) / 20.0, 0);
    node.from = node.point = k;
    node.held = k == 0 || k == 40;
  }
  task.plane = Vector3::UnitZ();
  task.within = 0.05;
  task.noise = task.within / 3;
  return task;
}

double greatest_curvature(const DenseCurve& curve) {
  double greatest = 0;
  for (std::uint32_t i = 0; i < curve.size(); ++i) greatest = std::max(greatest, curve.greatest_curvature(i));
  return greatest;
}

// An arc of radius R rounds a right angle off by (√2 − 1) R, so that 0.05 allows for 0.12, and twice as much where the
// sides lie outwards by 0.05 as well.
TEST(CurveFitter, KeepsALeastRadiusAtItsNodes) {
  CurveFitTask task = corner();
  for (const double radius : {0.1, 0.2}) {
    task.least_radius = radius;
    const CurveFound found = fit_curve(task, [](double) {});
    EXPECT_TRUE(found.converged) << radius;
    EXPECT_LE(greatest_curvature(found.curve), 1 / radius);
    EXPECT_LE(found.greatest, task.within);
  }
}

TEST(CurveFitter, ComesAsNearToALeastRadiusAsItCan) {
  CurveFitTask task = corner();
  task.least_radius = 1;
  const CurveFound found = fit_curve(task, [](double) {});
  EXPECT_FALSE(found.converged);
  EXPECT_LE(found.greatest, task.within) << "the tolerance comes first";
  const double bent = greatest_curvature(found.curve);
  EXPECT_GT(bent, 1);
  EXPECT_LT(bent, 1 / 0.25) << "sides may lean to make room";
}

}  // namespace
}  // namespace vspring::curve_fitter_test
