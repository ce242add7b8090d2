// Which results are an answer to what was asked.

#include <gtest/gtest.h>

#include "support/holes.hpp"
#include "vspring/vspring.hpp"

namespace vspring::usable_test {
namespace {

FairReport report_of(Outcome outcome) {
  FairReport report;
  report.outcome = outcome;
  return report;
}

TEST(Usable, OfOutcomesThatOfAnEquilibriumAlone) {
  EXPECT_TRUE(report_of(Outcome::converged).usable());
  for (const Outcome other :
       {Outcome::iteration_limit, Outcome::work_limit, Outcome::stalled, Outcome::worse_than_input, Outcome::cancelled})
    EXPECT_FALSE(report_of(other).usable()) << name(other);
}

TEST(Usable, AShapeOnTheWayIsNot) {
  const PolygonMesh mesh = generate::annulus({.nodes = 300});
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  EXPECT_TRUE(fair(mesh, constraints).report.usable());
  EXPECT_FALSE(fair(mesh, constraints, {.method = EquilibriumMethod{.max_iterations = 1}}).report.usable());
  Context context;
  context.cancel();
  EXPECT_FALSE(fair(mesh, constraints, {}, context).report.usable());
}

TEST(Usable, ASurfaceWithAHoleThatCannotBeFilledIsNot) {
  // Nothing but the disc itself, turned over, would close its rim; the hole within it can be filled.
  const PolygonMesh sheet = support::without_ball(generate::flat_disc({.nodes = 300}), Vector3::Zero(), 0.3);
  EXPECT_TRUE(fill_holes(sheet).usable());
  const FilledHoles asked = fill_holes(sheet, {.outer_rims = true});
  EXPECT_TRUE(asked.report.usable());
  EXPECT_FALSE(asked.usable());
}

}  // namespace
}  // namespace vspring::usable_test
