#include "base/cancellation.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "base/threads.hpp"
#include "vspring/fair.hpp"
#include "vspring/generate.hpp"

namespace vspring::cancellation_test {
namespace {

TEST(Cancellation, ThrowsOnceInItsScopes) {
  Context context;
  Context other;
  context.cancel();
  EXPECT_NO_THROW(end_if_cancelled()) << "in no scope";
  const CancellationScope outer(context);
  {
    const UncancelledScope whole;
    EXPECT_NO_THROW(end_if_cancelled());
    const CancellationScope of_another_call(other);
    EXPECT_NO_THROW(end_if_cancelled());
  }
  {
    const CancellationScope inner(context);
    EXPECT_THROW(end_if_cancelled(), Cancelled);
    EXPECT_NO_THROW(end_if_cancelled()) << "while what was left is cleared up";
  }
  EXPECT_NO_THROW(end_if_cancelled());
}

TEST(Cancellation, LeavesOtherContextsTheirOwn) {
  Context context;
  Context around;
  around.cancel();
  context.cancel();
  const CancellationScope outer(around);
  {
    const CancellationScope inner(context);
    EXPECT_THROW(end_if_cancelled(), Cancelled);
  }
  EXPECT_THROW(end_if_cancelled(), Cancelled);
}

TEST(Cancellation, EndsTheTasksOfATeam) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    Context context;
    const CancellationScope scope(context);
    std::atomic<int> done = 0;
    const auto cancel_at_first = [&](std::size_t /*task*/) {
      context.cancel();
      ++done;
    };
    EXPECT_THROW(team.run(1000000, cancel_at_first), Cancelled);
    EXPECT_LT(done, 1000000);
    done = 0;
    team.run(10, cancel_at_first);
    EXPECT_EQ(done, 10) << "to clear up";
  }
}

TEST(Cancellation, OfAFairingEndsItsPreparation) {
  // Before anything is computed on several threads.
  const PolygonMesh mesh = generate::add_noise(generate::annulus({.nodes = 20000}), 0.01, 1);
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  constraints.fix_position(0, mesh.position(0) + Vector3(0, 0, 0.1));
  Context context;
  context.threads = 2;
  std::size_t calls = 0;
  context.on_progress = [&](const Progress& /*progress*/) {
    context.cancel();
    calls = ThreadTeam::calls_for_help();
  };
  const FairResult result = fair(mesh, constraints, {}, context);
  EXPECT_EQ(ThreadTeam::calls_for_help(), calls);
  EXPECT_EQ(result.report.outcome, Outcome::cancelled);
  std::vector<Vector3> expected = mesh.positions();
  expected[0] = constraints.position(0);
  EXPECT_EQ(result.positions, expected);
  EXPECT_EQ(result.report.nodes, mesh.node_count());
  EXPECT_EQ(result.report.faces, mesh.face_count());
  EXPECT_EQ(result.report.moving_nodes + result.report.fixed_positions, mesh.node_count());
}

}  // namespace
}  // namespace vspring::cancellation_test
