#include <cmath>

#include "base/degrees.hpp"
#include "base/threads.hpp"
#include "fairness/curve_runs.hpp"
#include "spring/curve_force.hpp"
#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "vspring/fairness.hpp"

namespace vspring {

namespace {

/// The constraints with fixed nodes at their present positions.
Constraints at_present(const PolygonCurve& curve, const Constraints* constraints) {
  Constraints present = constraints != nullptr ? *constraints : Constraints(curve.node_count());
  for (Index i = 0; i < curve.node_count(); ++i) {
    if (present.position_fixed(i)) present.fix_position(i, curve.position(i));
  }
  return present;
}

}  // namespace

Fairness measure(const PolygonCurve& whole_curve, const Constraints* constraints) {
  const PolygonCurve curve = visible_part(whole_curve);
  Net net = gather_net(curve, at_present(curve, constraints));
  ThreadTeam alone(1);
  update_directions(net, *curve_model({}), alone);
  double energy = 0;
  double squared_turns = 0;
  double greatest_turn = 0;
  double turns = 0;
  for_each_curve_spring(net, [&](const Vector3& spring, const Vector3& d) {
    const double length = d.norm();
    if (length > 0) energy += (spring / length).squaredNorm();
  });
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    if (links.size() < 2) continue;
    const Vector3 before = net.positions[i] - net.positions[links[0].node()];
    const Vector3 after = net.positions[links[1].node()] - net.positions[i];
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    if (!std::isfinite(turn)) continue;
    squared_turns += turn * turn;
    greatest_turn = std::max(greatest_turn, turn);
    turns += 1;
  }
  Fairness fairness;
  fairness.vspring_energy = energy;
  fairness.greatest_turn = degrees_per_radian * greatest_turn;
  fairness.rms_turn = turns > 0 ? degrees_per_radian * std::sqrt(squared_turns / turns) : 0;
  return fairness;
}

}  // namespace vspring
