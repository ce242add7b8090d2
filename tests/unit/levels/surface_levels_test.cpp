#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "levels/levels.hpp"
#include "sweep/sweep.hpp"
#include "unit/levels/zoo.hpp"
#include "vspring/topology.hpp"

namespace vspring::surface_levels_test {
namespace {

std::vector<Level> levels_of(const PolygonMesh& mesh, const Constraints& constraints, int threads = 1,
                             Distribution distribution = Distribution::even) {
  ThreadTeam team(threads);
  return surface_levels(gather_net(mesh, constraints), *surface_model(PseudoNormals::link), distribution, team);
}

Constraints boundary_held(const PolygonMesh& mesh, bool normals) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  if (normals) fix_boundary_normals(constraints, mesh);
  return constraints;
}

/// What every net promises, see gather_net().
void expect_sound(const Net& net) {
  const std::size_t nodes = net.node.size();
  EXPECT_EQ(net.positions.size(), nodes);
  EXPECT_EQ(net.normals.size(), nodes);
  EXPECT_EQ(net.given.size(), nodes);
  EXPECT_EQ(net.rings.size(), net.computed);
  EXPECT_LE(net.moving, net.computed);
  EXPECT_LE(net.computed, nodes);
  EXPECT_TRUE(net.laplacian_weights.empty() || net.laplacian_weights.size() == net.rings.link_count());
  EXPECT_EQ(std::set<Index>(net.node.begin(), net.node.end()).size(), nodes);
  std::vector<std::uint8_t> beside_moving(nodes, 0);
  for (std::size_t i = 0; i < net.computed; ++i) {
    EXPECT_FALSE(net.rings.links(i).empty());
    for (const Link link : net.rings.links(i)) {
      ASSERT_LT(link.node(), nodes);
      EXPECT_NE(link.node(), i);
      if (i < net.moving && link.spoke()) beside_moving[link.node()] = 1;
    }
  }
  for (std::size_t i = net.moving; i < nodes; ++i) {
    const bool needs_ring = beside_moving[i] != 0 && !net.normal_given(i);
    EXPECT_EQ(i < net.computed, needs_ring) << i;
  }
}

TEST(SurfaceLevels, AreSoundNetsOfTheSameNodes) {
  for (const zoo::Shape& shape : zoo::surfaces()) {
    for (const bool normals : {false, true}) {
      SCOPED_TRACE(shape.name);
      Constraints constraints = boundary_held(shape.mesh, normals);
      constraints.fix_position(0, shape.mesh.position(0));
      const auto levels = levels_of(shape.mesh, constraints);
      for (std::size_t k = 0; k < levels.size(); ++k) {
        const Net& net = levels[k].net;
        expect_sound(net);
        if (k + 1 == levels.size()) continue;
        const Net& finer = levels[k + 1].net;
        EXPECT_GE(net.moving, 1U);
        EXPECT_LT(net.moving, finer.moving);
        ASSERT_EQ(levels[k].finer.size(), net.node.size());
        for (std::size_t i = 0; i < net.node.size(); ++i) {
          const std::size_t at = levels[k].finer[i];
          EXPECT_EQ(net.node[i], finer.node[at]);
          EXPECT_EQ(i < net.moving, at < finer.moving);
          EXPECT_EQ(net.given[i], finer.given[at]);
          EXPECT_EQ(net.positions[i], finer.positions[at]);
          if (net.normal_given(i)) {
            EXPECT_EQ(net.normals[i], finer.normals[at]);
          }
        }
        std::size_t removed = 0;
        for (const Removals& group : levels[k].removals) removed += group.size();
        EXPECT_EQ(removed + net.node.size(), finer.node.size());
      }
    }
  }
}

TEST(SurfaceLevels, GoDownToAFewMovingNodes) {
  for (const Index nodes : {300, 3000, 30000}) {
    const PolygonMesh mesh = generate::annulus({.nodes = nodes});
    const auto levels = levels_of(mesh, boundary_held(mesh, true));
    EXPECT_LE(levels.front().net.moving, 40U);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const double factor =
          static_cast<double>(levels[k + 1].net.node.size()) / static_cast<double>(levels[k].net.node.size());
      EXPECT_GT(factor, 2);
      EXPECT_LT(factor, 5.5);
    }
  }
}

TEST(SurfaceLevels, ThereIsOneOnlyForAFewNodes) {
  for (const Index nodes : {4, 7, 19}) {
    const PolygonMesh mesh = generate::flat_disc({.nodes = nodes});
    EXPECT_EQ(levels_of(mesh, boundary_held(mesh, false)).size(), 1U);
  }
  // Three nodes, one of them moving, and none at all.
  MeshBuilder builder;
  for (int k = 0; k < 3; ++k) builder.add_node({std::cos(k), std::sin(k), 0});
  builder.add_face({0, 1, 2});
  const PolygonMesh triangle = builder.take();
  Constraints constraints(3);
  constraints.fix_position(0, triangle.position(0));
  constraints.fix_position(1, triangle.position(1));
  EXPECT_EQ(levels_of(triangle, constraints).size(), 1U);
  constraints.fix_position(2, triangle.position(2));
  EXPECT_EQ(levels_of(triangle, constraints).size(), 1U);
}

TEST(SurfaceLevels, KeepHeldNodesInsideOnEveryLevel) {
  const PolygonMesh mesh = generate::cap({.nodes = 20000});
  Constraints constraints = boundary_held(mesh, true);
  const std::vector<Index> held = {0, 2500, 5000, 10000};
  for (const Index node : held) constraints.fix_position(node, mesh.position(node));
  constraints.fix_normal(held[1], mesh.position(held[1]));
  for (const Level& level : levels_of(mesh, constraints)) {
    for (const Index node : held) {
      const auto at = std::find(level.net.node.begin(), level.net.node.end(), node);
      ASSERT_NE(at, level.net.node.end()) << "of " << level.net.node.size();
      EXPECT_GE(static_cast<std::size_t>(at - level.net.node.begin()), level.net.moving);
    }
  }
}

TEST(SurfaceLevels, OfARegionStayInIt) {
  for (const auto faces : {generate::Faces::triangles, generate::Faces::hexagons}) {
    const PolygonMesh mesh = generate::torus({.columns = 120, .rows = 60, .faces = faces});
    std::vector<Index> region;
    for (Index i = 0; i < mesh.node_count(); ++i) {
      if ((mesh.position(i) - Vector3(1, 0, 0.4)).norm() < 0.5) region.push_back(i);
    }
    Constraints constraints(mesh.node_count());
    restrict_to_region(constraints, mesh, region);
    const auto levels = levels_of(mesh, constraints);
    EXPECT_GE(levels.size(), 3U);
    EXPECT_EQ(levels.back().net.moving, region.size());
    for (const Level& level : levels) expect_sound(level.net);
  }
}

TEST(SurfaceLevels, DoNotDependOnWhereNodesAre) {
  const PolygonMesh mesh = generate::annulus({.nodes = 5000});
  const PolygonMesh noisy = generate::add_noise(mesh, 0.2);
  const auto levels = levels_of(mesh, boundary_held(mesh, true));
  const auto other = levels_of(noisy, boundary_held(mesh, true));
  ASSERT_EQ(levels.size(), other.size());
  for (std::size_t k = 0; k < levels.size(); ++k) EXPECT_EQ(levels[k].net.node, other[k].net.node);
}

TEST(SurfaceLevels, HaveSharesWhereTheDistributionIsKept) {
  const PolygonMesh mesh = generate::plane({.columns = 30, .rows = 30, .jitter = 0.4});
  auto levels = levels_of(mesh, boundary_held(mesh, true), 1, Distribution::keep);
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  Sweep sweep(levels.back().net, *model, team);
  EXPECT_LT(sweep.iterate(), 1e-10);
  for (const Level& level : levels) EXPECT_EQ(level.net.laplacian_weights.size(), level.net.rings.link_count());
}

/// How many times as long as the shortest edge at a node the longest is, at worst.
double greatest_ratio(const Net& net) {
  double ratio = 1;
  for (std::size_t i = 0; i < net.moving; ++i) {
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke()) continue;
      const double length = (net.positions[link.node()] - net.positions[i]).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    ratio = std::max(ratio, longest / shortest);
  }
  return ratio;
}

TEST(SurfaceLevels, LongCellsBecomeEvenFromLevelToLevel) {
  for (const generate::Faces faces : {generate::Faces::quads, generate::Faces::triangles}) {
    // Sixteen times as long as wide.
    const PolygonMesh mesh = generate::tube({.columns = 16, .rows = 64, .faces = faces}, 1, 1.6);
    const auto levels = levels_of(mesh, boundary_held(mesh, true), 1, Distribution::smooth);
    EXPECT_GT(greatest_ratio(levels.back().net), 15);
    const auto& coarsest = levels[levels.size() > 4 ? levels.size() - 4 : 0].net;
    EXPECT_LT(greatest_ratio(coarsest), 5);
    for (const Level& level : levels) expect_sound(level.net);
  }
}

}  // namespace
}  // namespace vspring::surface_levels_test
