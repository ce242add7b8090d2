// What going to the equilibrium of a surface is claimed to do.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/fairness_of.hpp"
#include "support/methods.hpp"
#include "support/specimens.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_surface_equilibrium_test {
namespace {

using namespace support;

using generate::Faces;

FairOptions to_equilibrium(double tolerance = 1e-5) { return {.method = equilibrium_alone(tolerance)}; }

TEST(SurfaceEquilibrium, AFlatDiscWithNoiseBecomesTheSphereThatItsRimAsksFor) {
  for (const Index nodes : {100, 1000, 5000}) {
    SCOPED_TRACE(nodes);
    const PolygonMesh cap = generate::cap({.nodes = nodes, .half_angle = 60, .jitter = 0.3});
    const FairResult result = fair(flattened(cap, 60, 0.02), held_boundary(cap, radial), to_equilibrium(1e-12));
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
    EXPECT_LE(result.report.levels.back().iterations, 40);
  }
}

TEST(SurfaceEquilibrium, SoDoesEveryKindOfFace) {
  for (const Faces faces : every_kind) {
    for (const double jitter : {0.0, 0.3}) {
      SCOPED_TRACE(fmt::format("{}, jitter {}", static_cast<int>(faces), jitter));
      const PolygonMesh patch =
          generate::sphere_patch({.columns = 32, .rows = 32, .faces = faces, .jitter = jitter}, 1, 80);
      const Constraints constraints = held_boundary(patch, radial);
      std::vector<Vector3> flat = patch.positions();
      for (Index i = 0; i < patch.node_count(); ++i) {
        if (!constraints.position_fixed(i)) flat[static_cast<std::size_t>(i)].z() = 0.7;
      }
      const PolygonMesh start = generate::add_noise(with_positions(patch, flat), 0.02, 3);
      const FairResult result = fair(start, constraints, to_equilibrium(1e-12));
      EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
      EXPECT_LE(result.report.levels.back().iterations, 60);
    }
  }
}

TEST(SurfaceEquilibrium, TheSenseOfGivenNormalsDoesNotMatter) {
  const PolygonMesh cap = generate::sphere_patch({.columns = 16, .rows = 16}, 1, 60);
  const PolygonMesh start = generate::add_noise(cap, 0.02, 3);
  const auto faired = [&](double sense) {
    Constraints constraints = held_boundary(cap, [&](const Vector3& p) -> Vector3 { return sense * p; });
    // Of moving nodes, too.
    for (Index i = 0; i < cap.node_count(); i += 3) {
      if (!constraints.position_fixed(i)) constraints.fix_normal(i, sense * cap.position(i));
    }
    const FairResult result = fair(start, constraints, to_equilibrium());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    return result.positions;
  };
  EXPECT_LT(greatest_distance(faired(1), faired(-1)), 1e-5);
}

TEST(SurfaceEquilibrium, IterationsHardlyGrowWithTheNodes) {
  for (const Index nodes : {500, 8000}) {
    SCOPED_TRACE(nodes);
    const PolygonMesh cap = generate::cap({.nodes = nodes, .half_angle = 60});
    const FairResult result = fair(flattened(cap, 60, 0.02), held_boundary(cap, radial), to_equilibrium());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LE(result.report.levels.back().iterations, 7);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 2e-5);
  }
}

TEST(SurfaceEquilibrium, CoarserLevelsHaveNearlyTheShapeOfTheFinest) {
  // No sphere: edge springs would have another shape on every mesh.
  const PolygonMesh annulus = generate::annulus({.nodes = 14962, .boundary_nodes = 608});
  const FairReport report = fair(annulus, clamped_boundary(annulus), {}).report;
  EXPECT_EQ(report.outcome, Outcome::converged);
  ASSERT_GE(report.levels.size(), 4U);
  EXPECT_LE(report.levels.back().iterations, 4);
  EXPECT_LE(report.iterations, 40);
}

TEST(SurfaceEquilibrium, KeepsTheDistributionOfTheNodes) {
  const PolygonMesh cap = generate::cap({.nodes = 3000, .half_angle = 60, .jitter = 0.4});
  FairOptions options = to_equilibrium(1e-10);
  options.distribution = Distribution::keep;
  const FairResult result = fair(flattened(cap, 60, 0), held_boundary(cap, radial), options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-8);
}

TEST(SurfaceEquilibrium, CapsOfMoreThanHalfASphere) {
  for (const double half_angle : {30.0, 90.0, 105.0, 120.0}) {
    SCOPED_TRACE(half_angle);
    const PolygonMesh cap = generate::cap({.nodes = 2000, .half_angle = half_angle});
    const FairResult result = fair(flattened(cap, half_angle, 0.01), held_boundary(cap, radial), to_equilibrium(1e-10));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-8);
  }
}

TEST(SurfaceEquilibrium, ABoundaryWithoutNormalsIsFlatAndOneNormalTiltsTheMiddle) {
  const PolygonMesh disc = generate::flat_disc({.nodes = 1000, .jitter = 0.3});
  Constraints constraints = held_boundary(disc);
  const PolygonMesh noisy = generate::add_noise(disc, 0.05, 5);
  const FairResult flat = fair(noisy, constraints, to_equilibrium(1e-10));
  EXPECT_EQ(flat.report.outcome, Outcome::converged);
  for (const Vector3& p : flat.positions) EXPECT_NEAR(p.z(), 0, 1e-8);

  // Node 0 is the centre.
  constraints.fix_normal(0, Vector3(0.3, 0, 1));
  const FairResult tilted = fair(noisy, constraints, to_equilibrium(1e-8));
  EXPECT_EQ(tilted.report.outcome, Outcome::converged);
  // Spheres on both sides would not see the tilt.
  EXPECT_EQ(tilted.report.springs, Springs::edge);
  double highest = 0;
  for (const Vector3& p : tilted.positions) highest = std::max(highest, std::abs(p.z()));
  EXPECT_GT(highest, 0.005);
  EXPECT_LT(highest, 0.5);
}

TEST(SurfaceEquilibrium, DoesNotDependOnTheStart) {
  const PolygonMesh funnel = generate::funnel(600);
  const Constraints constraints = clamped_boundary(funnel);
  // Spacing, where it is kept, is that of the start.
  FairOptions even = to_equilibrium(1e-11);
  even.distribution = Distribution::even;
  const FairResult expected = fair(funnel, constraints, even);
  ASSERT_EQ(expected.report.outcome, Outcome::converged);
  std::vector<PolygonMesh> starts;
  for (const double noise : {0.05, 0.3, 1.0}) starts.push_back(generate::add_noise(funnel, noise, 9));
  std::vector<Vector3> bulged = funnel.positions();
  for (Vector3& p : bulged) p.z() += 0.3 * std::sin(3 * p.x()) * p.y();
  starts.push_back(with_positions(funnel, bulged));
  starts.push_back(with_positions(
      funnel, std::vector<Vector3>(static_cast<std::size_t>(funnel.node_count()), Vector3(0.2, 0.1, 0))));
  for (std::size_t k = 0; k < starts.size(); ++k) {
    SCOPED_TRACE(k);
    const FairResult result = fair(starts[k], constraints, even);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(greatest_distance(result.positions, expected.positions), 1e-8);
  }
}

TEST(SurfaceEquilibrium, AFairShapeIsLeftAsItIs) {
  std::vector<PolygonMesh> meshes = {generate::funnel(1000), generate::annulus({.nodes = 1000})};
  for (const Faces faces : {Faces::triangles, Faces::quads}) meshes.push_back(generate::pipe_blend({.faces = faces}));
  for (const PolygonMesh& mesh : meshes) {
    SCOPED_TRACE(mesh.face_count());
    const Constraints constraints = clamped_boundary(mesh);
    // Without noise in it a spacing that is made smooth again still slides a little along the shape.
    FairOptions options = to_equilibrium();
    options.distribution = Distribution::even;
    const FairResult once = fair(mesh, constraints, options);
    ASSERT_EQ(once.report.outcome, Outcome::converged);
    const FairResult twice = fair(with_positions(mesh, once.positions), constraints, options);
    EXPECT_EQ(twice.report.iterations, 1);
    EXPECT_LT(greatest_distance(once.positions, twice.positions), 1e-14 * diagonal(mesh));
  }
}

TEST(SurfaceEquilibrium, ThreadsGiveTheSameBits) {
  const PolygonMesh cap = generate::cap({.nodes = 4600, .half_angle = 70});
  const PolygonMesh start = flattened(cap, 70, 0.02);
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fair(start, held_boundary(cap, radial), to_equilibrium(), context);
  };
  const FairResult one = run(1);
  for (const int threads : {2, 3}) {
    const FairResult other = run(threads);
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.report.history, other.report.history);
  }
}

TEST(SurfaceEquilibrium, CanBeCancelled) {
  // So many that progress is told long before the end.
  const PolygonMesh cap = generate::cap({.nodes = 20000, .half_angle = 60});
  const PolygonMesh start = flattened(cap, 60, 0.02);
  Context before;
  before.cancel();
  const FairResult none = fair(start, held_boundary(cap, radial), to_equilibrium(), before);
  EXPECT_EQ(none.report.outcome, Outcome::cancelled);
  EXPECT_LT(greatest_distance(none.positions, start.positions()), 1e-14);
  Context amid;
  amid.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, 0);
    EXPECT_LE(progress.fraction, 1);
    if (progress.iteration > 0) amid.cancel();
  };
  const FairResult some = fair(start, held_boundary(cap, radial), to_equilibrium(), amid);
  EXPECT_EQ(some.report.outcome, Outcome::cancelled);
  for (const Vector3& p : some.positions) EXPECT_TRUE(p.allFinite());
}

TEST(SurfaceEquilibrium, WhenCancelledNeverLeavesAShapeWorseThanTheInput) {
  // Thin and noisy faces around one node: on the way the shape is crumpled.
  constexpr Index sides = 2000;
  MeshBuilder builder;
  builder.add_node({0, 0, 0.3});
  for (const auto& [radius, height] : {std::pair(1.0, 0.25), std::pair(1.2, 0.1), std::pair(1.4, 0.0)}) {
    for (Index k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      const double noise = 0.004 * std::sin(1e3 * k * k);
      builder.add_node({radius * std::cos(angle), radius * std::sin(angle), height + noise});
    }
  }
  for (Index k = 0; k < sides; ++k) {
    const Index next = (k + 1) % sides;
    builder.add_face({0, k + 1, next + 1});
    for (const Index ring : {1, 1 + sides})
      builder.add_face({ring + k, ring + sides + k, ring + sides + next, ring + next});
  }
  const PolygonMesh mesh = builder.take();
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  for (const int iterations : {1, 100}) {
    Context context;
    context.on_progress = [&](const Progress& progress) {
      if (progress.iteration >= iterations) context.cancel();
    };
    const FairResult result = fair(mesh, constraints, {}, context);
    EXPECT_EQ(result.report.outcome, Outcome::cancelled) << iterations;
    const auto [before, after] = fairness_of(mesh, constraints, result.positions);
    EXPECT_LE(after.rms_turn, before.rms_turn) << iterations;
    EXPECT_LE(after.vspring_energy, before.vspring_energy) << iterations;
  }
}

TEST(SurfaceEquilibrium, TheExpectedErrorIsWithinAFactorOfThreeOfTheTrueOne) {
  struct Case {
    std::string name;
    PolygonMesh mesh;
    Constraints constraints;
  };
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const PolygonMesh& mesh) {
    cases.push_back({name, mesh, clamped_boundary(mesh)});
  };
  for (const Index nodes : {300, 1200}) {
    const PolygonMesh cap = generate::cap({.nodes = nodes, .half_angle = 60});
    cases.push_back({fmt::format("cap {}", nodes), flattened(cap, 60, 0.02), held_boundary(cap, radial)});
    add(fmt::format("funnel {}", nodes), generate::funnel(nodes));
    add(fmt::format("annulus {}", nodes), generate::annulus({.nodes = nodes}));
  }
  add("pipes", generate::pipe_blend({.cells = 6}));
  add("pipes of triangles", generate::pipe_blend({.cells = 6, .faces = Faces::triangles}));
  for (const Faces faces : every_kind) {
    const PolygonMesh patch =
        generate::cylinder_patch({.columns = 16, .rows = 16, .faces = faces, .jitter = 0.3}, 1, 120, 2);
    cases.push_back({fmt::format("cylinder of faces {}", static_cast<int>(faces)), generate::add_noise(patch, 0.02, 3),
                     clamped_boundary(patch)});
  }
  for (const Case& one : cases) {
    const FairResult truth = fair(one.mesh, one.constraints, to_equilibrium(1e-12));
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      SCOPED_TRACE(fmt::format("{} to {}", one.name, tolerance));
      const FairResult result = fair(one.mesh, one.constraints, to_equilibrium(tolerance));
      ASSERT_EQ(result.report.outcome, Outcome::converged);
      ASSERT_TRUE(result.report.expected_error.has_value());
      const double expected = *result.report.expected_error;
      EXPECT_LT(expected, tolerance);
      const double error = greatest_distance(result.positions, truth.positions) / diagonal(one.mesh);
      EXPECT_LT(error, 3 * expected);
      EXPECT_GT(error, expected / 3);
    }
  }
}

TEST(SurfaceEquilibrium, ABumpOnASphereFairedAsARegionGoes) {
  for (const Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh sphere =
        generate::sphere_patch({.columns = 60, .rows = 60, .faces = faces, .jitter = 0.3}, 1, 90);
    std::vector<Index> region;
    std::vector<Vector3> bumped = sphere.positions();
    for (Index i = 0; i < sphere.node_count(); ++i) {
      const double from_pole = (sphere.position(i) - Vector3(0, 0, 1)).norm();
      if (from_pole > 0.45) continue;
      region.push_back(i);
      bumped[static_cast<std::size_t>(i)] *= 1 + 0.3 * std::exp(-20 * from_pole * from_pole);
    }
    const PolygonMesh mesh = with_positions(sphere, bumped);
    Constraints constraints(mesh.node_count());
    restrict_to_region(constraints, mesh, region);
    const FairResult result = fair(mesh, constraints, to_equilibrium(1e-11));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-7);
  }
}

TEST(SurfaceEquilibrium, OfSphereSpringsDoesNotDependOnWhichWayEdgesRun) {
  const Normal up = [](const Vector3&) { return Vector3::UnitZ(); };
  // How far the meridian is from that of the same funnel on another mesh.
  const auto difference = [&](Springs springs) {
    std::vector<std::vector<Vector3>> meridians;
    for (const bool narrow : {true, false}) {
      const generate::Grid rings{
          .columns = narrow ? 64 : 24, .rows = 10, .faces = narrow ? Faces::quads : Faces::triangles};
      const Specimen funnel = on_chart("", funnel_chart, true, rings, {}, up);
      FairOptions options = to_equilibrium(1e-8);
      options.springs = springs;
      const FairResult result = fair(funnel.start, funnel.constraints, options);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.report.springs, springs);
      auto& meridian = meridians.emplace_back();
      for (int row = 0; row <= rings.rows; ++row) {
        const Vector3& p = result.positions[static_cast<std::size_t>(row) * static_cast<std::size_t>(rings.columns)];
        meridian.emplace_back(p.head<2>().norm(), 0, p.z());
      }
    }
    return distance(meridians[0], PolygonCurve(meridians[1])).greatest;
  };
  EXPECT_LT(difference(Springs::sphere), 0.003);
  EXPECT_GT(difference(Springs::edge), 0.01);
}

}  // namespace
}  // namespace vspring::fair_surface_equilibrium_test
