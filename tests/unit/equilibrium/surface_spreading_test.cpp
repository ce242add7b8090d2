#include "equilibrium/surface_spreading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "levels/levels.hpp"
#include "precondition/surface_systems.hpp"
#include "support/surfaces.hpp"

namespace vspring::surface_spreading_test {
namespace {

using namespace support;

/// The two finest levels of a cap whose nodes lie on the sphere but not where the regularisation wants them.
struct TwoLevels {
  explicit TwoLevels(int threads) : team(threads) {
    const PolygonMesh cap = generate::cap({.nodes = 16'000, .half_angle = 60, .jitter = 0.3});
    levels = surface_levels(gather_net(cap, held_boundary(cap, radial)), *model, Distribution::even, team);
    centre = fine().frame.to_local(Vector3::Zero());
    radius = fine().frame.scale();
    for (std::size_t i = 0; i < coarse().moving; ++i) {
      const Vector3 from = (coarse().positions[i] - centre) / radius;
      const Vector3 push = 0.3 * (from.z() - 0.5) * Vector3(from.y() - 0.5, -from.x(), 0.2);
      coarse().positions[i] = centre + radius * (from + push).normalized();
    }
    update_directions(coarse(), *model, team);
    hand_up();
  }

  Net& fine() { return levels.back().net; }
  Net& coarse() { return levels[levels.size() - 2].net; }
  void hand_up() {
    prolong_surface(levels[levels.size() - 2], levels.back(), team);
    update_directions(fine(), *model, team);
  }
  SystemLevels systems() {
    SystemLevels systems = {.net = &fine()};
    for (std::size_t k = levels.size() - 1; levels[k].net.moving > 1000; --k)
      systems.interpolations.push_back(interpolation(levels[k].net, levels[k - 1].net, levels[k - 1].finer, team));
    return systems;
  }

  ThreadTeam team;
  std::unique_ptr<const Model> model = surface_model(PseudoNormals::link);
  std::vector<Level> levels;
  Vector3 centre;
  double radius = 0;
};

/// The greatest distance of a node from where its neighbours have their mean, along the surface, in edges.
double greatest_miss(const Net& net) {
  double greatest = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    Vector3 miss = mean_of_neighbours(net, i) - net.positions[i];
    miss -= miss.dot(net.normals[i]) * net.normals[i];
    greatest = std::max(greatest, miss.norm());
  }
  return greatest / mean_edge(net);
}

/// The greatest way of a node that one exact solve would send it, in edges.
double greatest_way(TwoLevels& surface) {
  const Net& net = surface.fine();
  std::vector<Vector3> ways(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) {
    Vector3 pull = Vector3::Zero();
    for (const Link link : net.rings.links(i)) pull += net.positions[link.node()] - net.positions[i];
    ways[i] = pull - pull.dot(net.normals[i]) * net.normals[i];
  }
  spreading_solver({.net = &net}, surface.team)->solve(ways, {});
  double greatest = 0;
  for (const Vector3& way : ways) greatest = std::max(greatest, way.norm());
  return greatest / mean_edge(net);
}

double distance_from_sphere(TwoLevels& surface) {
  double greatest = 0;
  for (const Vector3& position : surface.fine().positions)
    greatest = std::max(greatest, std::abs((position - surface.centre).norm() - surface.radius));
  return greatest / surface.radius;
}

TEST(SurfaceSpreading, TheCoarserLevelDoesTheLongWaysForTheFinerOne) {
  TwoLevels surface(2);
  const double before = greatest_way(surface);
  ASSERT_GT(before, 5);
  const SystemLevels systems = surface.systems();
  const auto spreading = spreading_solver(systems, surface.team);
  ASSERT_TRUE(
      spread_coarser(surface.coarse(), surface.fine(), systems.interpolations.front(), *spreading, surface.team));
  surface.hand_up();
  EXPECT_LT(greatest_way(surface), 0.2 * before);
  EXPECT_LT(distance_from_sphere(surface), 1e-12);
}

TEST(SurfaceSpreading, NodesEndAtTheMeanOfTheirNeighbours) {
  TwoLevels surface(2);
  const SystemLevels systems = surface.systems();
  const auto spreading = spreading_solver(systems, surface.team);
  spread_along(surface.fine(), *spreading, TangentialRigidModes(surface.fine()), surface.team);
  EXPECT_LT(greatest_miss(surface.fine()), 0.02);
  EXPECT_LT(greatest_way(surface), 0.5);
  EXPECT_LT(distance_from_sphere(surface), 1e-12);
}

TEST(SurfaceSpreading, NothingMovesWhereNodesAreInPlace) {
  TwoLevels surface(1);
  const SystemLevels systems = surface.systems();
  const auto spreading = spreading_solver(systems, surface.team);
  for (int pass = 0; pass < 3; ++pass) {
    (void)spread_coarser(surface.coarse(), surface.fine(), systems.interpolations.front(), *spreading, surface.team);
    surface.hand_up();
  }
  spread_along(surface.fine(), *spreading, TangentialRigidModes(surface.fine()), surface.team);
  const std::vector<Vector3> places = surface.fine().positions;
  spread_along(surface.fine(), *spreading, TangentialRigidModes(surface.fine()), surface.team);
  double greatest = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    greatest = std::max(greatest, (surface.fine().positions[i] - places[i]).norm());
  EXPECT_LT(greatest, 0.1 * mean_edge(surface.fine()));
}

TEST(SurfaceSpreading, SameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<Vector3>> places;
  for (const int threads : {1, 2}) {
    TwoLevels surface(threads);
    const SystemLevels systems = surface.systems();
    const auto spreading = spreading_solver(systems, surface.team);
    (void)spread_coarser(surface.coarse(), surface.fine(), systems.interpolations.front(), *spreading, surface.team);
    surface.hand_up();
    spread_along(surface.fine(), *spreading, TangentialRigidModes(surface.fine()), surface.team);
    places.push_back(surface.fine().positions);
  }
  EXPECT_EQ(places[0], places[1]);
}

}  // namespace
}  // namespace vspring::surface_spreading_test
