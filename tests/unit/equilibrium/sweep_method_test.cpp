#include "equilibrium/sweep_method.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::sweep_method_test {
namespace {

TEST(SweepMethod, EndsWithTheBestShapeWhereNodesAreNoLongerFinite) {
  const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12});
  const PolygonMesh bumpy = generate::add_noise(plane, 0.02, 1);
  Net net = gather_net(bumpy, support::held_boundary(bumpy));
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  for (const double gone : {std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    int iterations = 0;
    SweepTask task{.step_tolerance = 1e-12, .max_iterations = 100};
    task.on_iteration = [&](double residual) {
      if (++iterations == 20) net.positions[7].x() = gone;
      EXPECT_EQ(std::isfinite(residual), iterations <= 20);
    };
    Context context;
    const SweepResult result = sweep_until_still(net, *model, task, team, context);
    EXPECT_EQ(result.outcome, Outcome::stalled);
    EXPECT_TRUE(result.lost);
    EXPECT_EQ(result.iterations, 21);
    for (const Vector3& position : net.positions) EXPECT_LT(position.cwiseAbs().maxCoeff(), 2);
  }
}

TEST(SweepMethod, KeepsTheShapeOfTheLastIterationWhereThatIsAskedFor) {
  const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12});
  const PolygonMesh bumpy = generate::add_noise(plane, 0.02, 1);
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  for (const bool keep_last : {false, true}) {
    Net net = gather_net(bumpy, support::held_boundary(bumpy));
    std::vector<Vector3> last;
    double last_residual = 0;
    SweepTask task{.step_tolerance = 1e-12, .max_iterations = 22, .keep_last = keep_last};
    int iterations = 0;
    task.on_iteration = [&](double residual) {
      if (++iterations == 20) net.positions[7].x() += 1;
      last = net.positions;
      last_residual = residual;
    };
    Context context;
    const SweepResult result = sweep_until_still(net, *model, task, team, context);
    EXPECT_EQ(result.outcome, Outcome::iteration_limit);
    EXPECT_EQ(result.iterations, 22);
    EXPECT_EQ(result.lost, !keep_last);
    EXPECT_EQ(net.positions == last, keep_last);
    EXPECT_EQ(result.residual == last_residual, keep_last);
  }
}

}  // namespace
}  // namespace vspring::sweep_method_test
