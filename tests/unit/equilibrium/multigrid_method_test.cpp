#include "equilibrium/multigrid_method.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::multigrid_method_test {
namespace {

using namespace support;

bool warns_of_a_level(const FairReport& report) {
  return std::ranges::any_of(report.warnings, [](const Warning& warning) {
    return warning.code == WarningCode::level_cut_short && warning.text.find("the coarsest level") != std::string::npos;
  });
}

TEST(MultigridMethod, SaysThatACoarserLevelWasCutShortThoughTheFinestIsStill) {
  const PolygonMesh mesh = generate::annulus({.nodes = 800});
  // The finest level is still soon; the coarsest would have to go on until its steps are a thousandth of that.
  MultigridMethod method = {.step_tolerance = 0.05, .max_iterations = 12};
  const FairReport cut = fair(mesh, held_boundary(mesh), {.method = method}).report;
  ASSERT_GT(cut.levels.size(), 1U);
  EXPECT_EQ(cut.outcome, Outcome::converged);
  EXPECT_EQ(cut.levels.back().outcome, Outcome::converged);
  EXPECT_EQ(cut.levels.front().outcome, Outcome::iteration_limit);
  EXPECT_TRUE(warns_of_a_level(cut));

  method.max_iterations = MultigridMethod().max_iterations;
  const FairReport whole = fair(mesh, held_boundary(mesh), {.method = method}).report;
  EXPECT_EQ(whole.levels.front().outcome, Outcome::converged);
  EXPECT_FALSE(warns_of_a_level(whole));
}

TEST(MultigridMethod, SaysWhichLevelsWereNotReached) {
  const PolygonMesh mesh = generate::annulus({.nodes = 800});
  Context context;
  context.on_progress = [&](const Progress& progress) {
    if (progress.iteration > 0) context.cancel();
  };
  const FairReport report = fair(mesh, held_boundary(mesh), {.method = MultigridMethod{}}, context).report;
  EXPECT_EQ(report.outcome, Outcome::cancelled);
  ASSERT_GT(report.levels.size(), 1U);
  for (const LevelReport& level : report.levels) EXPECT_EQ(level.outcome, Outcome::cancelled);
}

}  // namespace
}  // namespace vspring::multigrid_method_test
