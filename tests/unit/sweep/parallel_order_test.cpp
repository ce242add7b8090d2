#include <gtest/gtest.h>

#include "spring/net.hpp"
#include "sweep/sweep.hpp"
#include "vspring/generate.hpp"

namespace vspring::parallel_order_test {
namespace {

Net net_of(generate::Faces faces, int size) {
  const PolygonMesh mesh =
      generate::plane({.columns = size, .rows = size, .faces = faces, .jitter = 0.4, .seed = 3}, 1, 1);
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  return gather_net(mesh, constraints);
}

TEST(Sweep, BlocksOfAGroupShareNoEdgeAndCoverEveryMovingNodeOnce) {
  for (const auto faces : {generate::Faces::triangles, generate::Faces::hexagons}) {
    const Net net = net_of(faces, 90);
    const auto groups = parallel_order(net);
    EXPECT_LT(groups.size(), 8U);
    std::vector<int> covered(net.moving, 0);
    for (const auto& group : groups) {
      std::vector<int> block_of(net.node.size(), -1);
      for (std::size_t b = 0; b < group.size(); ++b) {
        for (std::size_t i = group[b].begin; i < group[b].end; ++i) {
          ++covered[i];
          block_of[i] = static_cast<int>(b);
        }
      }
      for (std::size_t i = 0; i < net.moving; ++i) {
        if (block_of[i] < 0) continue;
        for (const Link link : net.rings.links(i)) {
          if (link.spoke() && block_of[link.node()] >= 0) {
            EXPECT_EQ(block_of[link.node()], block_of[i]);
          }
        }
      }
    }
    for (const int times : covered) EXPECT_EQ(times, 1);
  }
}

TEST(Sweep, NeighboursLieCloseInMemory) {
  const Net net = net_of(generate::Faces::triangles, 200);
  std::size_t furthest = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (link.node() < net.moving) furthest = std::max(furthest, link.node() > i ? link.node() - i : i - link.node());
    }
  }
  // A breadth-first front of a 200 × 200 grid holds some 400 nodes.
  EXPECT_LT(furthest, 1000U);
}

TEST(SweepThreads, GiveTheSameBitsForEveryNumber) {
  const auto run = [](int threads) {
    Net net = net_of(generate::Faces::mixed, 60);
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i].z() = 0.01 * static_cast<double>(i % 7);
    ThreadTeam team(threads);
    const auto model = surface_model(PseudoNormals::link);
    Sweep sweep(net, *model, team);
    for (int k = 0; k < 20; ++k) sweep.iterate();
    return net.positions;
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(3));
}

TEST(Sweep, KeepingTheDistributionLeavesEveryNodeOfAPlaneInItsPlace) {
  Net net = net_of(generate::Faces::mixed, 20);
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  Sweep sweep(net, *model, team);
  set_laplacian_weights(net, *model, Distribution::keep, team);
  EXPECT_LT(sweep.iterate(), 1e-12);
  set_laplacian_weights(net, *model, Distribution::even, team);
  EXPECT_GT(sweep.iterate(), 1e-2);
}

TEST(Sweep, SharesAddUpToOneAndPointAtTheNode) {
  Net net = net_of(generate::Faces::triangles, 12);
  ThreadTeam team(1);
  set_laplacian_weights(net, *surface_model(PseudoNormals::link), Distribution::keep, team);
  const auto& shares = net.laplacian_weights;
  for (std::size_t i = 0; i < net.moving; ++i) {
    double sum = 0;
    Vector3 mean = Vector3::Zero();
    const auto links = net.rings.links(i);
    for (std::size_t k = 0; k < links.size(); ++k) {
      sum += shares[net.rings.begin(i) + k];
      mean += shares[net.rings.begin(i) + k] * net.positions[links[k].node()];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT((mean - net.positions[i]).norm(), 1e-12);
  }
}

TEST(Sweep, NoNeighbourDrivesANodeAwayThatNoiseHasPutOutsideThemAll) {
  Net net = net_of(generate::Faces::triangles, 12);
  // Over the neighbours and beyond.
  const std::size_t node = 30;
  net.positions[node] = net.positions[net.rings.links(node).front().node()] * 2 - net.positions[node];
  ThreadTeam team(1);
  set_laplacian_weights(net, *surface_model(PseudoNormals::link), Distribution::keep, team);
  double sum = 0;
  for (const double share : net.weights_of(node)) {
    EXPECT_GT(share, 0.01);
    sum += share;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

}  // namespace
}  // namespace vspring::parallel_order_test
