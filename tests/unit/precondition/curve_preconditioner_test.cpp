#include "precondition/curve_preconditioner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "support/curves.hpp"

namespace vspring::curve_preconditioner_test {
namespace {

using namespace support;

/// A line and its nodes moved across it a little.
struct Bent {
  std::vector<Vector3> equilibrium;
  std::vector<Vector3> nodes;
  Constraints constraints;
};

constexpr double slope = 1e-6;

Bent bent(Spacing spacing, const std::function<void(Constraints&, const std::vector<Vector3>&)>& hold_more) {
  const auto line = straight({0, 0, 0}, {1, 0.2, 0.3}, places(spacing, 24, 4));
  Constraints constraints = held_ends(line);
  hold_more(constraints, line);
  const Vector3 along = (line.back() - line.front()).normalized();
  auto nodes = line;
  Draw draw(6);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector3 offset = draw.in_cube(slope / 24);
    if (!constraints.position_fixed(static_cast<Index>(i))) nodes[i] += offset - offset.dot(along) * along;
  }
  return {line, nodes, constraints};
}

/// How far nodes are from the equilibrium after one correction, relative to before.
double left_over(const Bent& curve, Distribution distribution) {
  ThreadTeam alone(1);
  const auto model = curve_model({});
  Net net = gather_net(PolygonCurve(curve.nodes), curve.constraints);
  model->prepare(net);
  set_laplacian_weights(net, *model, distribution, alone);
  CurvePreconditioner preconditioner(net);
  update_directions(net, *model, alone);
  std::vector<NodeForce> forces(net.moving);
  model->find_forces(net, {0, net.moving}, forces);
  preconditioner.refresh(*model);
  std::vector<Vector3> correction;
  preconditioner.correct(*model, 0, correction);
  for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] += correction[i];
  const auto corrected = scatter_positions(net, curve.nodes, curve.constraints, 1);
  return greatest_distance(corrected, curve.equilibrium) / greatest_distance(curve.nodes, curve.equilibrium);
}

const Vector3 line_tangent(1, 0.2, 0.3);

TEST(CurvePreconditioner, OneStepSolvesNearlyStraightCurvesHoweverTheyAreHeldAndSpaced) {
  for (const Spacing spacing : {Spacing::even, Spacing::random, Spacing::alternating, Spacing::jump}) {
    const std::vector<std::function<void(Constraints&, const std::vector<Vector3>&)>> ways = {
        [](Constraints&, const std::vector<Vector3>&) {},
        [](Constraints& c, const std::vector<Vector3>&) { c.fix_tangent(0, line_tangent); },
        [](Constraints& c, const std::vector<Vector3>&) {
          c.fix_tangent(0, line_tangent);
          c.fix_tangent(24, line_tangent);
        },
        [](Constraints& c, const std::vector<Vector3>& line) { hold(c, line, 10); },
        [](Constraints& c, const std::vector<Vector3>& line) {
          hold(c, line, 10);
          hold(c, line, 11);
          hold(c, line, 18);
          c.fix_tangent(18, line_tangent);
        },
        // A moving node that has a tangent.
        [](Constraints& c, const std::vector<Vector3>&) { c.fix_tangent(7, line_tangent); },
    };
    for (std::size_t way = 0; way < ways.size(); ++way)
      EXPECT_LT(left_over(bent(spacing, ways[way]), Distribution::keep), 1e-4)
          << "spacing " << static_cast<int>(spacing) << ", held in way " << way;
  }
}

TEST(CurvePreconditioner, OneStepSpreadsNodesAlongALine) {
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    const auto uneven = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::graded, 30, 8));
    const auto even = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 30));
    const Bent curve = {even, uneven, held_ends(uneven)};
    EXPECT_NEAR(left_over(curve, distribution), distribution == Distribution::even ? 0 : 1, 1e-12);
  }
}

TEST(CurvePreconditioner, CutsClosedChainsAtAHeldNodeWithoutATrace) {
  // In a plane, where frames come round as they went, a closed chain is corrected in the same way from wherever it
  // starts.
  const int count = 40;
  std::vector<Vector3> nodes;
  nodes.reserve(count);
  Draw draw(2);
  for (int k = 0; k < count; ++k)
    nodes.emplace_back((1 + draw.uniform(-1e-3, 1e-3)) * heading(360 * degree * k / count));
  Constraints constraints(count);
  for (const Index i : {3, 15, 31}) hold(constraints, nodes, i);
  std::vector<std::vector<Vector3>> results;
  for (const int shift : {0, 10, 25}) {
    PolygonCurve::Chain chain = {.nodes = {}, .closed = true};
    for (int k = 0; k < count; ++k) chain.nodes.push_back((k + shift) % count);
    ThreadTeam alone(1);
    const auto model = curve_model({});
    Net net = gather_net(PolygonCurve(nodes, {chain}), constraints);
    model->prepare(net);
    CurvePreconditioner preconditioner(net);
    update_directions(net, *model, alone);
    std::vector<NodeForce> forces(net.moving);
    model->find_forces(net, {0, net.moving}, forces);
    preconditioner.refresh(*model);
    std::vector<Vector3> correction;
    preconditioner.correct(*model, 0, correction);
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] += correction[i];
    results.push_back(scatter_positions(net, nodes, constraints, 1));
  }
  const double moved = greatest_distance(results[0], nodes);
  EXPECT_GT(moved, 1e-4);
  EXPECT_LT(greatest_distance(results[0], results[1]), 1e-10 * moved);
  EXPECT_LT(greatest_distance(results[0], results[2]), 1e-10 * moved);
}

}  // namespace
}  // namespace vspring::curve_preconditioner_test
