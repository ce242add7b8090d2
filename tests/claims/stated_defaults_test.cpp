// What headers say that an empty option means: giving that gives the same bits.

#include <gtest/gtest.h>

#include <optional>

#include "support/holes.hpp"
#include "support/masks.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::stated_defaults_test {
namespace {

using support::held_boundary;

FairOptions with(FairingMethod method, std::optional<Distribution> distribution) {
  return {.method = method, .distribution = distribution};
}

TEST(StatedDefaults, TheDistributionOfEachMethod) {
  const PolygonMesh mesh = generate::annulus({.nodes = 300});
  const Constraints held = held_boundary(mesh);
  const auto expect_same = [&](const FairingMethod& method, Distribution stated) {
    const FairResult said = fair(mesh, held, with(method, stated));
    EXPECT_EQ(said.positions, fair(mesh, held, with(method, {})).positions) << name(said.report.method);
  };
  expect_same(EquilibriumMethod{}, Distribution::smooth);
  expect_same(MultigridMethod{}, Distribution::even);
  expect_same(SweepMethod{.step_tolerance = 0.1}, Distribution::even);
}

TEST(StatedDefaults, TheDistributionOfCurves) {
  const PolygonCurve curve({{0, 0, 0}, {1, 0.2, 0}, {2.5, 0.1, 0}, {3, 0.4, 0}, {5, 0, 0}, {5.5, 1, 0}});
  Constraints held(curve.node_count());
  fix_boundary_positions(held, curve);
  EXPECT_EQ(fair(curve, held, with(EquilibriumMethod{}, Distribution::even)).positions, fair(curve, held).positions);
}

TEST(StatedDefaults, TheDistributionOfPatchesAndOfVoxels) {
  const PolygonMesh sheet = support::without_ball(generate::flat_disc({.nodes = 300}), Vector3::Zero(), 0.3);
  const FairOptions keep = with(EquilibriumMethod{}, Distribution::keep);
  EXPECT_EQ(fill_holes(sheet, {.fair = keep}).positions, fill_holes(sheet).positions);

  const PolygonMesh ball = support::sides_of_voxels(Vector3::Ones(), Vector3::Constant(5),
                                                    [](const Vector3& middle) { return middle.norm() < 4; });
  const ScatteredPoints own = {.positions = ball.positions()};
  FitOptions options = {.criterion = Voxels{Vector3::Ones()}};
  const FitResult plain = fit(ball, Constraints(ball.node_count()), own, options);
  options.fair = keep;
  EXPECT_EQ(fit(ball, Constraints(ball.node_count()), own, options).positions, plain.positions);
}

TEST(StatedDefaults, HolesOfAnySize) {
  const PolygonMesh sheet = support::without_ball(generate::flat_disc({.nodes = 300}), Vector3::Zero(), 0.3);
  const Hole hole = find_holes(sheet).front();
  const FillOptions said = {.most_length = 2 * hole.length, .most_edges = static_cast<Index>(hole.rim.size())};
  EXPECT_EQ(fill_holes(sheet, said).positions, fill_holes(sheet).positions);
}

TEST(StatedDefaults, TheNumberOfLevels) {
  const PolygonMesh mesh = generate::annulus({.nodes = 800});
  const FairResult plain = fair(mesh, held_boundary(mesh), {.method = MultigridMethod{}});
  ASSERT_GT(plain.report.levels.size(), 1U);
  EXPECT_GE(plain.report.levels.front().moving_nodes, 60);
  const auto count = static_cast<int>(plain.report.levels.size());
  EXPECT_EQ(fair(mesh, held_boundary(mesh), {.method = MultigridMethod{.levels = count}}).positions, plain.positions);
}

}  // namespace
}  // namespace vspring::stated_defaults_test
