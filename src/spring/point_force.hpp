#pragma once

#include <algorithm>

#include "spring/net.hpp"

namespace vspring {

/// The force of the points tied to a node.
struct PointForce {
  Vector3 displacement = Vector3::Zero();  ///< dPc_i of §4.5
  double stiffness = 0;                    ///< how much it falls per length that the node moves along it
};

/// Eq. 9 and the average of its displacements with w_j = 1/‖P_i − Q_j‖, times the node's factor. sprung(d): the part of
/// d along which the springs of the node act; the rest of V_j − P_i leads to the foot Q_j. Feet nearer than a hundredth
/// of the mean edge count as that near: so weights are bounded, and do not jump when a node slides past the foot of a
/// point.
template <typename Sprung>
PointForce point_force(const Net& net, std::size_t i, double mean_edge, const Sprung& sprung) {
  const double nearest_foot = 0.01 * mean_edge;
  PointForce force;
  double weights = 0;
  for (const std::uint32_t j : net.points.of(i)) {
    const Vector3 d = net.points.positions[j] - net.positions[i];
    const Vector3 along = sprung(d);
    const double weight = 1 / std::max((d - along).norm(), nearest_foot);
    const double stiffness = weight * net.points.weights[j];
    weights += weight;
    force.displacement += stiffness * along;
    force.stiffness += stiffness;
  }
  if (weights > 0) {
    const double share = net.points.factor(i) / weights;
    force.displacement *= share;
    force.stiffness *= share;
  }
  return force;
}

}  // namespace vspring
