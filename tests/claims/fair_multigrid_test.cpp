// What the paper's V-cycle (§4.7) is claimed to do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/fairness_of.hpp"
#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_multigrid_test {
namespace {

using namespace support;

FairOptions multigrid(double step_tolerance = 1e-3, std::optional<int> levels = std::nullopt) {
  return {.method = MultigridMethod{.step_tolerance = step_tolerance, .levels = levels}};
}

TEST(Multigrid, AFlatDiscBecomesTheCapOfWhateverPolygons) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh patch = generate::sphere_patch({.columns = 12, .rows = 12, .faces = faces, .jitter = 0.2}, 1, 60);
    const FairResult result = fair(generate::add_noise(patch, 0.05, 3), held_boundary(patch, radial), multigrid(1e-9));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-6);
  }
}

TEST(Multigrid, GetsFarNearerThanThePlainIterationWithTheSameTest) {
  const PolygonMesh cap = generate::cap({.nodes = 1801, .radius = 1, .half_angle = 60});
  const FairResult swept = fair(pressed(cap, 0.5), held_boundary(cap, radial), {.method = SweepMethod{}});
  const FairResult cycled = fair(pressed(cap, 0.5), held_boundary(cap, radial), multigrid());
  EXPECT_EQ(swept.report.outcome, Outcome::converged);
  EXPECT_EQ(cycled.report.outcome, Outcome::converged);
  EXPECT_GT(distance_from_unit_sphere(swept.positions), 0.3);
  EXPECT_LT(distance_from_unit_sphere(cycled.positions), 0.02);
}

TEST(Multigrid, GetsNearerWithFinerMeshesWhereTheTestGoesWithTheFourthPowerOfTheSpacing) {
  const auto error = [](Index nodes, double e) {
    const PolygonMesh cap = generate::cap({.nodes = nodes, .radius = 1, .half_angle = 60});
    const FairResult result = fair(pressed(cap, 0.5), held_boundary(cap, radial), multigrid(e, 6));
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    return distance_from_unit_sphere(result.positions);
  };
  const double coarse = error(127, 1e-3);
  const double fine = error(4921, 1e-3 / 1024);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(fine, 0.5 * error(4921, 1e-3));
}

TEST(Multigrid, TellsOfEveryLevel) {
  const PolygonMesh cap = generate::cap({.nodes = 4921, .radius = 1, .half_angle = 60});
  const FairReport six = fair(cap, held_boundary(cap, radial), multigrid(1e-3, 6)).report;
  ASSERT_GE(six.levels.size(), 5U);
  ASSERT_LE(six.levels.size(), 6U);
  int iterations = 0;
  for (std::size_t k = 0; k < six.levels.size(); ++k) {
    iterations += six.levels[k].iterations;
    EXPECT_GT(six.levels[k].seconds, 0);
    if (k > 0) {
      EXPECT_GT(six.levels[k].moving_nodes, 3 * six.levels[k - 1].moving_nodes);
      EXPECT_GE(six.levels[k].iterations, MultigridMethod().pre_smoothing + 1);
    }
  }
  EXPECT_EQ(iterations, six.iterations);
  EXPECT_EQ(six.levels.back().moving_nodes, six.moving_nodes);
  EXPECT_EQ(fair(cap, held_boundary(cap, radial), multigrid(1e-3, 3)).report.levels.size(), 3U);
  EXPECT_EQ(fair(cap, held_boundary(cap, radial), multigrid(1e-3, 1)).report.levels.size(), 1U);
}

TEST(Multigrid, HasFewerLevelsWhereThereIsTooLittle) {
  const PolygonMesh cap = generate::cap({.nodes = 19, .radius = 1, .half_angle = 60});
  const FairResult result = fair(pressed(cap, 0.5), held_boundary(cap, radial), multigrid(1e-12));
  EXPECT_EQ(result.report.levels.size(), 1U);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
}

TEST(Multigrid, FiveIterationsOnTheWayDownTakeNoiseOut) {
  const PolygonMesh annulus = generate::annulus({.nodes = 553, .boundary_nodes = 121});
  const PolygonMesh noisy = generate::add_noise(annulus, 0.05, 7);
  const Constraints constraints = clamped_boundary(annulus);
  const FairResult clean = fair(annulus, constraints, multigrid(1e-7));
  const FairResult rough = fair(noisy, constraints, multigrid(1e-7));
  EXPECT_EQ(rough.report.outcome, Outcome::converged);
  const auto [before, after] = fairness_of(noisy, constraints, rough.positions);
  EXPECT_GT(before.rms_turn, 5 * after.rms_turn);
  EXPECT_LT(greatest_distance(clean.positions, rough.positions), 1e-3);
}

TEST(Multigrid, SameBitsOnAnyNumberOfThreads) {
  const PolygonMesh cap = generate::cap({.nodes = 1801, .radius = 1, .half_angle = 60});
  const auto with = [&](int threads) {
    Context context;
    context.threads = threads;
    return fair(pressed(cap, 0.5), held_boundary(cap, radial), multigrid(), context).positions;
  };
  EXPECT_EQ(with(1), with(2));
  EXPECT_EQ(with(1), with(3));
}

TEST(Multigrid, FixedNodesStayBitForBit) {
  const PolygonMesh cap = generate::cap({.nodes = 469, .radius = 1, .half_angle = 60});
  Constraints constraints = held_boundary(cap, radial);
  constraints.fix_position(17, Vector3(0.1, 0.2, 1.0));
  const FairResult result = fair(pressed(cap, 0.5), constraints, multigrid());
  for (Index i = 0; i < cap.node_count(); ++i) {
    if (!constraints.position_fixed(i)) continue;
    EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], constraints.position(i));
  }
}

TEST(Multigrid, CancellationEndsWithTheShapeSoFar) {
  const PolygonMesh cap = generate::cap({.nodes = 4921, .radius = 1, .half_angle = 60});
  Context context;
  int calls = 0;
  context.on_progress = [&](const Progress&) {
    if (++calls == 2) context.cancel();
  };
  const FairResult result = fair(pressed(cap, 0.5), held_boundary(cap, radial), multigrid(1e-12), context);
  EXPECT_EQ(result.report.outcome, Outcome::cancelled);
  for (const Vector3& position : result.positions) EXPECT_TRUE(position.allFinite());
}

TEST(Multigrid, CurvesHaveLevelsToo) {
  std::vector<Vector3> positions;
  for (int k = 0; k <= 400; ++k) {
    const double angle = 2.0 * k / 400;
    const double noise = k == 0 || k == 400 ? 0 : 0.02 * std::sin(1000.0 * k);
    positions.emplace_back((1 + noise) * std::cos(angle), (1 + noise) * std::sin(angle), 0);
  }
  const PolygonCurve curve(positions);
  Constraints constraints(curve.node_count());
  fix_boundary_positions(constraints, curve);
  constraints.fix_tangent(0, Vector3(0, 1, 0));
  constraints.fix_tangent(400, Vector3(-std::sin(2.0), std::cos(2.0), 0));
  const FairResult result = fair(curve, constraints, multigrid(1e-6));
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_GT(result.report.levels.size(), 2U);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-3);
}

TEST(Multigrid, CurvesOfAHundredEdgesHaveLevels) {
  std::vector<Vector3> line;
  for (int k = 0; k <= 100; ++k) line.emplace_back(0.01 * k, 0, 0);
  Constraints constraints(101);
  fix_boundary_positions(constraints, PolygonCurve(line));
  constraints.fix_tangent(0, {1, 1, 0});
  constraints.fix_tangent(100, {1, -1, 0});
  // The arc of 90° over a chord of 1.
  const auto distance_from_arc = [&](const FairingMethod& method) {
    const FairResult result = fair(PolygonCurve(line), constraints, {.method = method});
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.levels.size() > 1, result.report.method == Method::multigrid);
    double greatest = 0;
    for (const Vector3& p : result.positions)
      greatest = std::max(greatest, std::abs((p - Vector3(0.5, -0.5, 0)).norm() - std::sqrt(0.5)));
    return greatest;
  };
  EXPECT_LT(10 * distance_from_arc(MultigridMethod{}), distance_from_arc(SweepMethod{}));
}

TEST(Multigrid, CoarseLevelsFoldNothing) {
  // From their levels of 20 and of 25 nodes the V-cycle ends with creases of 86° and of 69°.
  for (const auto& [nodes, boundary_nodes] : {std::pair(2720, 260), std::pair(2760, 262)}) {
    const PolygonMesh annulus = generate::annulus({.nodes = nodes, .boundary_nodes = boundary_nodes});
    const Constraints constraints = clamped_boundary(annulus);
    for (const auto& [method, normals] :
         {std::pair<FairingMethod, PseudoNormals>(MultigridMethod{}, PseudoNormals::link),
          std::pair<FairingMethod, PseudoNormals>(equilibrium_alone(), PseudoNormals::angle)}) {
      FairOptions options;
      options.method = method;
      options.pseudo_normals = normals;
      const FairResult result = fair(annulus, constraints, options);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_LT(fairness_of(annulus, constraints, result.positions).after.greatest_turn, 15);
    }
  }
}

}  // namespace
}  // namespace vspring::fair_multigrid_test
