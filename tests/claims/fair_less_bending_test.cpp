// Where no shape is found whose curvature changes evenly: one of least bending is, or one that is bent less than it
// came.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_less_bending_test {
namespace {

using namespace support;
using generate::Faces;

double bending(const PolygonMesh& mesh, const std::vector<Vector3>& positions) {
  return measure_surface(with_positions(mesh, positions)).bending_energy;
}

bool has(const FairReport& report, WarningCode code) {
  for (const Warning& warning : report.warnings) {
    if (warning.code == code) return true;
  }
  return false;
}

TEST(FairLessBending, ATubeWithoutAnEquilibriumBecomesOneOfLeastBending) {
  for (const double height : {6, 12}) {
    SCOPED_TRACE(height);
    const PolygonMesh tube =
        generate::add_noise(generate::tube({.columns = 12, .rows = 16, .faces = Faces::hexagons}, 1, height), 0.05, 3);
    const FairResult result = fair(tube, held_boundary(tube));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.fair_by, FairBy::bending);
    EXPECT_TRUE(has(result.report, WarningCode::other_fairness));
    EXPECT_FALSE(has(result.report, WarningCode::no_equilibrium));
    EXPECT_LT(bending(tube, result.positions), 0.8 * bending(tube, tube.positions()));
    // Whoever wants nothing else gets what there is.
    FairOptions alone;
    alone.method = EquilibriumMethod{.fallbacks = false};
    EXPECT_NE(fair(tube, held_boundary(tube), alone).report.outcome, Outcome::converged);
  }
}

TEST(FairLessBending, WhereFacesWouldTurnOverNodesStay) {
  // Few columns: the least shape is folded.
  const PolygonMesh tube =
      generate::add_noise(generate::tube({.columns = 7, .rows = 8, .faces = Faces::triangles}, 1, 4), 0.3, 2);
  const FairResult result = fair(tube, held_boundary(tube));
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair_by, FairBy::bending);
  const auto& levels = result.report.levels;
  EXPECT_TRUE(std::any_of(levels.begin(), levels.end(), [&](const LevelReport& level) {
    return level.kept_nodes > 0 && level.kept_nodes < result.report.moving_nodes;
  }));
  EXPECT_LE(measure_surface(with_positions(tube, result.positions)).flipped_faces, measure_surface(tube).flipped_faces);
  EXPECT_LT(bending(tube, result.positions), 0.8 * bending(tube, tube.positions()));
  const auto& warnings = result.report.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
    return warning.code == WarningCode::other_fairness && warning.text.find("nodes stay") != std::string::npos;
  }));
}

TEST(FairLessBending, ABentTubeIsNotPinched) {
  // It would swell for ever, and nodes stay where faces would turn over: in creases of nearly 90°. So it stays nearer.
  const PolygonMesh tube = bent_tube(16, 24, 0.45, 5);
  const FairResult result = fair(tube, held_boundary(tube));
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair_by, FairBy::bending);
  EXPECT_LT(bending(tube, result.positions), bending(tube, tube.positions()));
  EXPECT_LT(measure(with_positions(tube, result.positions)).greatest_turn, 70);
  EXPECT_EQ(result.report.levels.back().kept_nodes, 0);
}

/// Of bricks.
PolygonMesh flat_ring(int columns, int rows, double inner, double outer) {
  PolygonMesh ring = generate::tube({.columns = columns, .rows = rows, .faces = Faces::hexagons}, 1, 1);
  const auto [lowest, highest] = std::minmax_element(ring.positions().begin(), ring.positions().end(),
                                                     [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  std::vector<Vector3> flat;
  for (const Vector3& p : ring.positions()) {
    const double radius = inner + (outer - inner) * (p.z() - lowest->z()) / (highest->z() - lowest->z());
    flat.emplace_back(radius * p.x(), radius * p.y(), 0);
  }
  ring.set_positions(std::move(flat));
  return ring;
}

TEST(FairLessBending, AFlatRingIsNotFoldedIntoItsHole) {
  // What is folded flat is an equilibrium, and bent by nothing.
  const PolygonMesh ring = flat_ring(46, 26, 0.65, 1.55);
  for (const std::uint64_t seed : {1U, 3U}) {
    SCOPED_TRACE(seed);
    // Of noise as long as the shorter edges.
    const PolygonMesh noisy = generate::add_noise(ring, 0.037, seed);
    ASSERT_GT(measure(noisy).greatest_turn, 90);
    const FairResult result = fair(noisy, held_boundary(noisy, [](const Vector3&) { return Vector3(0, 0, 1); }));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(measure(with_positions(noisy, result.positions)).greatest_turn, 1);
  }
}

TEST(FairLessBending, AFlatRingThatCameFlatIsTheAnswer) {
  // Its nodes would fold as they are spread.
  const PolygonMesh ring = flat_ring(22, 13, 0.2, 1);
  const FairResult result = fair(ring, held_boundary(ring));
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.positions, ring.positions());
}

TEST(FairLessBending, FromAMembraneWhatNoiseHasCrumpledIsForgotten) {
  const PolygonMesh tube = generate::tube({.columns = 10, .rows = 6, .faces = Faces::hexagons}, 1, 3);
  std::vector<std::vector<Vector3>> found;
  for (const std::uint64_t seed : {1U, 9U}) {
    SCOPED_TRACE(seed);
    const PolygonMesh crumpled = generate::add_noise(tube, 0.5, seed);
    ASSERT_GT(measure(crumpled).greatest_turn, 120);
    const FairResult result = fair(crumpled, held_boundary(crumpled));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.fair_by, FairBy::bending);
    EXPECT_LT(measure(with_positions(tube, result.positions)).greatest_turn, 80);
    EXPECT_LT(bending(tube, result.positions), bending(crumpled, crumpled.positions()) / 2);
    found.push_back(result.positions);
  }
  // Held nodes have no noise; the others have forgotten theirs.
  EXPECT_LT(greatest_distance(found[0], found[1]), 1e-3);
}

}  // namespace
}  // namespace vspring::fair_less_bending_test
