#include "equilibrium/edge_turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "spring/model.hpp"
#include "support/surfaces.hpp"

namespace vspring::edge_turns_test {
namespace {

using namespace support;

double longest_of(const std::vector<Vector3>& steps) {
  double longest = 0;
  for (const Vector3& step : steps) longest = std::max(longest, step.norm());
  return longest;
}

// Steps from far too long to next to nothing, each taken: what is told is what all edges say, or a bound for it within
// the limit.
TEST(TurnLimit, TellsTheLargestTurnOrABoundWithinTheLimit) {
  constexpr double limit = 0.3;
  ThreadTeam team(1);
  const std::unique_ptr<const Model> model = surface_model(PseudoNormals::link);
  const PolygonMesh cap = generate::cap({.nodes = 400, .half_angle = 60, .jitter = 0.3});
  Net net = gather_net(cap, held_boundary(cap, radial));
  TurnLimit turns(net, limit, team);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  int bounds = 0;
  int beyond = 0;
  std::vector<Vector3> steps(net.moving);
  for (int k = 0; k < 200; ++k) {
    update_directions(net, *model, team);
    const double length = std::pow(10, -1 - 4 * std::abs(share(random)));
    for (Vector3& step : steps) step = length * Vector3(share(random), share(random), share(random));
    const double longest = longest_of(steps);
    const double largest = edge_turns(net, steps, team).largest;
    const double told = turns.turn(steps, longest);
    ASSERT_GE(told, largest);
    if (largest > limit) {
      ASSERT_EQ(told, largest);
      ++beyond;
    }
    if (told > largest) {
      ASSERT_LE(told, limit);
      ++bounds;
    }
    const double taken = std::min(1.0, limit / told);
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] += taken * steps[i];
    turns.moved(taken * longest);
  }
  EXPECT_GT(bounds, 20);
  EXPECT_GT(beyond, 20);
}

// A bound from edges as they were before they grew shorter would be none.
TEST(TurnLimit, KnowsThatEdgesMayHaveGrownShorter) {
  constexpr double limit = 0.3;
  constexpr double share = 0.05;
  ThreadTeam team(1);
  const std::unique_ptr<const Model> model = surface_model(PseudoNormals::link);
  const PolygonMesh plane = generate::plane({.columns = 8, .rows = 8});
  Net net = gather_net(plane, held_boundary(plane));
  update_directions(net, *model, team);
  TurnLimit turns(net, limit, team);
  std::vector<Vector3> steps(net.moving, Vector3::Zero());
  (void)turns.turn(steps, 0);
  const double edge = edge_turns(net, steps, team).shortest;
  double longest = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Vector3 before = net.positions[i];
    net.positions[i] *= share;
    longest = std::max(longest, (net.positions[i] - before).norm());
  }
  turns.moved(longest);
  for (std::size_t i = 0; i < net.moving; ++i) steps[i].z() = (i % 2 == 0 ? 0.1 : -0.1) * edge;
  const double largest = edge_turns(net, steps, team).largest;
  ASSERT_GT(largest, limit);
  ASSERT_LT(2 * longest_of(steps) / edge, limit) << "or the old edges would say the same";
  EXPECT_EQ(turns.turn(steps, longest_of(steps)), largest);
}

}  // namespace
}  // namespace vspring::edge_turns_test
