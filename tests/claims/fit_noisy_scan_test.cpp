// Closed surfaces with noise that folds them, fitted to their own nodes, which keep their places.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_noisy_scan_test {
namespace {

using namespace support;

constexpr double minor_radius = 0.45;

PolygonMesh exact() {
  return generate::torus({.columns = 32, .rows = 14, .faces = generate::Faces::quads}, 1, minor_radius);
}

/// Moved by up to three quarters of a mean edge.
PolygonMesh folded() { return generate::add_noise(exact(), 0.15, 1); }

double rms_from_torus(const std::vector<Vector3>& positions) {
  double squares = 0;
  for (const Vector3& p : positions) {
    const double d = std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - minor_radius;
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(positions.size()));
}

/// In degrees.
double greatest_turn(const PolygonMesh& mesh, const std::vector<Vector3>& positions) {
  PolygonMesh shape = mesh;
  shape.set_positions(positions);
  return measure(shape).greatest_turn;
}

TEST(FitNoisyScan, NoFoldIsLeftWhateverIsAskedFor) {
  const PolygonMesh noisy = folded();
  const double before = rms_from_torus(noisy.positions());
  ASSERT_GT(greatest_turn(noisy, noisy.positions()), 120);
  FitOptions ways[4];
  ways[0].within = 0.15;
  ways[1].rms = before;
  ways[2].smoothing_length = 0.2;
  ways[3].weight = 0.03;
  for (FitOptions& options : ways) {
    SCOPED_TRACE(&options - ways);
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(noisy, Constraints(noisy.node_count()), {.positions = noisy.positions()}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LT(greatest_turn(noisy, result.positions), 60);
    EXPECT_LT(rms_from_torus(result.positions), before / 2);
  }
}

}  // namespace
}  // namespace vspring::fit_noisy_scan_test
