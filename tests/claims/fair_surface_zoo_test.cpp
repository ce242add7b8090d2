// What holds for every shape of the zoo: spheres come out exactly on meshes of every kind, cylinders to their order,
// and the expected error is true.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/methods.hpp"
#include "support/specimens.hpp"

namespace vspring::fair_surface_zoo_test {
namespace {

using namespace support;
using generate::Faces;

FairOptions to_equilibrium(double tolerance, std::optional<Distribution> distribution = Distribution::even) {
  FairOptions options;
  options.method = equilibrium_alone(tolerance);
  options.distribution = distribution;
  return options;
}

TEST(Zoo, SpheresOnIrregularMeshesOfEveryKind) {
  std::vector<Specimen> all;
  for (const Faces faces : every_kind) {
    const generate::Grid grid{.columns = 24, .rows = 24, .faces = faces};
    all.push_back(on_chart("graded " + name_of(faces), sphere_chart, false, grid, {.ratio = 10}, radial));
  }
  // Nodes of bricks lie on a line with two of their three neighbours: no shares keep them off it.
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    const generate::Grid grid{.columns = 24, .rows = 24, .faces = faces};
    all.push_back(on_chart("kept " + name_of(faces), sphere_chart, false, grid, {.jitter = 0.5}, radial));
    all.back().distribution = Distribution::keep;
  }
  const PolygonMesh polygons = projected(dual(generate::cap({.nodes = 600, .jitter = 0.5})));
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    all.push_back({"n-gons", flattened(polygons, 60, 0), held_boundary(polygons, radial), distribution});
  }
  for (const int sides : {3, 5, 7, 12}) {
    const PolygonMesh polygon = polygon_cap(sides, 4);
    all.push_back({fmt::format("polygon of {} sides", sides), pressed(polygon, 0.5), held_boundary(polygon, radial)});
  }
  for (const Specimen& one : all) {
    SCOPED_TRACE(one.name);
    ASSERT_GT(distance_from_unit_sphere(one.start.positions()), 0.1);
    const FairResult result = fair(one.start, one.constraints, to_equilibrium(1e-12, one.distribution));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
  }
}

TEST(Zoo, PolygonsOfHundredsOfSidesBecomeSpheres) {
  // They are cut for the solver: what they become does not depend on how.
  for (const int sides : {200, 300}) {
    const PolygonMesh polygon = polygon_cap(sides, 6);
    const FairResult result = fair(pressed(polygon, 0.9), held_boundary(polygon, radial), to_equilibrium(1e-6));
    EXPECT_EQ(result.report.outcome, Outcome::converged) << sides;
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-6) << sides;
  }
}

/// The distance of an equilibrium from the cylinder of radius 1.
double cylinder_error(Faces faces, int cells, bool estimated_normals, Springs springs = Springs::sphere) {
  const Normal from_axis = [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); };
  Specimen specimen =
      on_chart("", cylinder_chart, false, {.columns = cells, .rows = cells, .faces = faces}, {}, from_axis);
  if (estimated_normals) {
    const PolygonMesh exact =
        generate::cylinder_patch({.columns = cells, .rows = cells, .faces = faces, .jitter = 0.2}, 1, 120, 2);
    specimen = {"", generate::add_noise(exact, 0.02, 3), clamped_boundary(exact)};
  }
  FairOptions options = to_equilibrium(1e-10);
  options.springs = springs;
  const FairResult result = fair(specimen.start, specimen.constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.springs, springs);
  double greatest = 0;
  for (const Vector3& p : result.positions) greatest = std::max(greatest, std::abs(p.head<2>().norm() - 1));
  return greatest;
}

TEST(Zoo, CylindersToTheirOrder) {
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    SCOPED_TRACE(name_of(faces));
    // Every node sees the same: edge springs have no error of their own.
    EXPECT_LT(cylinder_error(faces, 24, false, Springs::edge), 1e-9);
    EXPECT_LT(cylinder_error(faces, 24, false), 2e-6);
    const double error = cylinder_error(faces, 24, true);
    EXPECT_GT(std::log2(cylinder_error(faces, 12, true) / error), 2.5);
    EXPECT_GT(std::log2(error / cylinder_error(faces, 48, true)), 2.5);
  }
  for (const Faces faces : {Faces::mixed, Faces::hexagons}) {
    SCOPED_TRACE(name_of(faces));
    const auto order = [&](Springs springs) {
      return std::log2(cylinder_error(faces, 12, false, springs) / cylinder_error(faces, 48, false, springs)) / 2;
    };
    EXPECT_GT(order(Springs::edge), 0.75);
    EXPECT_LT(order(Springs::edge), 1.25);
    EXPECT_GT(order(Springs::sphere), 2.25);
    EXPECT_LT(cylinder_error(faces, 24, false), 0.05 * cylinder_error(faces, 24, false, Springs::edge));
  }
}

TEST(Zoo, CylindersOfGradedAndJitteredGrids) {
  const Normal from_axis = [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); };
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    for (const Disorder& disorder : {Disorder{.jitter = 0.3}, Disorder{.ratio = 10}}) {
      SCOPED_TRACE(fmt::format("{}, jitter {}, graded {}", name_of(faces), disorder.jitter, disorder.ratio));
      const Specimen specimen =
          on_chart("", cylinder_chart, false, {.columns = 24, .rows = 24, .faces = faces}, disorder, from_axis);
      FairOptions options = to_equilibrium(1e-9);
      options.distribution = Distribution::keep;
      const FairResult result = fair(specimen.start, specimen.constraints, options);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.report.springs, Springs::sphere);
      for (const Vector3& p : result.positions) ASSERT_LT(std::abs(p.head<2>().norm() - 1), 1e-4);
    }
  }
}

TEST(Zoo, FineMeshesOfMixedFacesNeedFewIterations) {
  // What comes from coarser levels is nearly in place, with nodes where the regularisation wants them.
  const Normal up = [](const Vector3&) { return Vector3::UnitZ(); };
  for (const double noise : {0.0, 1.0 / 130}) {
    const Specimen funnel =
        on_chart("", funnel_chart, true, {.columns = 260, .rows = 65, .faces = Faces::mixed}, {.noise = noise}, up);
    const FairReport report = fair(funnel.start, funnel.constraints, {}).report;
    EXPECT_EQ(report.outcome, Outcome::converged);
    EXPECT_EQ(report.springs, Springs::sphere);
    EXPECT_LE(report.levels.back().iterations, 8);
  }
}

TEST(Zoo, BandsOfCellsManyTimesAsWideAsHighBecomeSpheresFromFarOff) {
  // 8 to 13 times as wide, lifted in the middle by a fifth of the radius.
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    for (const auto& [columns, rows] : {std::pair<Index, Index>(24, 24), {24, 30}, {18, 30}, {64, 64}}) {
      SCOPED_TRACE(fmt::format("{}, {} x {}", name_of(faces), columns, rows));
      const Specimen band =
          on_chart("", band_chart, true, {.columns = columns, .rows = rows, .faces = faces}, {}, radial);
      ASSERT_GT(distance_from_unit_sphere(band.start.positions()), 0.19);
      const FairResult result = fair(band.start, band.constraints, {});
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.report.springs, Springs::sphere);
      EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-5);
    }
  }
}

TEST(Zoo, ATighterToleranceDoesNotChangeTheSprings) {
  // Cells 100 : 1, where sphere springs come to 2e-9 of the size and no nearer.
  const Normal up = [](const Vector3&) { return Vector3::UnitZ(); };
  const Specimen funnel =
      on_chart("", funnel_chart, true, {.columns = 96, .rows = 24, .faces = Faces::quads}, {.ratio = 100}, up);
  const double size = diagonal(funnel.start, funnel.constraints);
  const FairResult loose = fair(funnel.start, funnel.constraints, {.method = EquilibriumMethod{.tolerance = 1e-5}});
  const FairResult tight = fair(funnel.start, funnel.constraints, {.method = EquilibriumMethod{.tolerance = 1e-9}});
  EXPECT_EQ(loose.report.outcome, Outcome::converged);
  EXPECT_EQ(tight.report.springs, Springs::sphere);
  EXPECT_LT(tight.report.expected_error.value_or(1), 1e-8);
  EXPECT_LT(greatest_distance(loose.positions, tight.positions), 1e-5 * size);
}

TEST(Zoo, TheTrueErrorIsWithinAFactorOfThreeOfTheExpectedOne) {
  for (const Specimen& specimen : specimens(12)) {
    if (specimen.hard) continue;
    const FairResult truth = fair(specimen.start, specimen.constraints, to_equilibrium(1e-12, specimen.distribution));
    const double size = diagonal(specimen.start, specimen.constraints);
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      SCOPED_TRACE(fmt::format("{} to {}", specimen.name, tolerance));
      const FairResult result =
          fair(specimen.start, specimen.constraints, to_equilibrium(tolerance, specimen.distribution));
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      const double expected = *result.report.expected_error;
      const double error = greatest_distance(result.positions, truth.positions) / size;
      EXPECT_LT(error, 3 * expected);
      // Of sphere springs corrections alone may be several times too long, where faces are of several kinds.
      EXPECT_GT(error, expected / (result.report.springs == Springs::edge ? 3 : 10));
    }
  }
}

TEST(Zoo, APolygonOfManySidesAmidRingsOfQuadsIsFaired) {
  // Quads shrink inwards by a factor a ring.
  const PolygonMesh polygon = polygon_cap(12, 12);
  const FairResult result =
      fair(pressed(polygon, 0.5), held_boundary(polygon, radial), {.method = EquilibriumMethod{.tolerance = 1e-10}});
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-8);
}

TEST(Zoo, CrumpledPatchesComeToAnEquilibrium) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonMesh start = generate::add_noise(generate::plane({.columns = 6, .rows = 6}), 0.25, seed);
    const FairResult result = fair(start, clamped_boundary(start), to_equilibrium(1e-5));
    EXPECT_GT(measure(start).greatest_turn, 90);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
  }
}

}  // namespace
}  // namespace vspring::fair_surface_zoo_test
