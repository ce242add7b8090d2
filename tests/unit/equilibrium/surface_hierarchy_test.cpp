#include "equilibrium/surface_hierarchy.hpp"

#include <gtest/gtest.h>

#include "levels/levels.hpp"
#include "spring/model.hpp"
#include "support/surfaces.hpp"

namespace vspring::surface_hierarchy_test {
namespace {

TEST(SurfaceHierarchy, GivesTheMemoryBackOfWhatALevelIsDoneWith) {
  ThreadTeam team(2);
  const auto model = surface_model(PseudoNormals::link);
  const PolygonMesh disc = generate::flat_disc({.nodes = 3000, .jitter = 0.3});
  SurfaceHierarchy hierarchy(
      surface_levels(gather_net(disc, support::held_boundary(disc)), *model, Distribution::keep, team), team);
  ASSERT_GT(hierarchy.count(), 1U);
  const std::size_t coarse = hierarchy.count() - 2;
  EXPECT_GT(hierarchy.net(coarse).laplacian_weights.capacity(), 0U);
  hierarchy.forget(coarse);
  EXPECT_EQ(hierarchy.net(coarse).laplacian_weights.capacity(), 0U);
  EXPECT_FALSE(hierarchy.net(coarse + 1).laplacian_weights.empty()) << "the finer one still needs its own";
}

}  // namespace
}  // namespace vspring::surface_hierarchy_test
