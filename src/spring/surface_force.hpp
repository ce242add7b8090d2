#pragma once

#include <type_traits>

#include "spring/net.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

/// The divisor of the regularisation: a target counts as much as all neighbours together.
inline double regularisation_divisor(const Net& net) { return net.target_positions.empty() ? 1 : 2; }

/// The force of its neighbours, and of its target if there is one, on a node of a surface.
inline NodeForce surface_force(const Net& net, std::size_t i, Forces forces = Forces::steady) {
  const auto links = net.rings.links(i);
  const auto from_neighbours = [&]<SpringKind kind>(std::integral_constant<SpringKind, kind>) {
    return node_force<kind>(i, links, net.positions, net.normals, net.weights_of(i), net.tiny);
  };
  const auto between_neighbours = [&]() -> NodeForce {
    if (net.spheres.on() && !links.empty() && (!on_boundary(links) || net.slides(i))) {
      NodeForce force = from_neighbours(std::integral_constant<SpringKind, SpringKind::other>());
      force.spring = sphere_force(net, i) * net.normals[i];
      return force;
    }
    if (forces == Forces::printed) return from_neighbours(std::integral_constant<SpringKind, SpringKind::printed>());
    return from_neighbours(std::integral_constant<SpringKind, SpringKind::steady>());
  };
  NodeForce force = between_neighbours();
  if (net.target_positions.empty()) return force;
  const Vector3 target = net.target_positions[i] - net.positions[i];
  const Vector3 across = target - target.dot(net.normals[i]) * net.normals[i];
  force.regularisation = (force.regularisation + across) / regularisation_divisor(net);
  return force;
}

}  // namespace vspring
