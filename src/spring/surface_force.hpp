#pragma once

#include <type_traits>

#include "spring/net.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

/// How many times what neighbours ask across the normal the regularisation is divided by: a home counts as much as all
/// of them together.
inline double regularisation_divisor(const Net& net) { return net.homes.empty() ? 1 : 2; }

/// What its neighbours, and its home where nodes have one, ask of a node of a surface.
inline NodeForce surface_force(const Net& net, std::size_t i) {
  const auto links = net.rings.links(i);
  const auto from_neighbours = [&]<bool with_spring>(std::bool_constant<with_spring>) {
    return node_force<with_spring>(i, links, net.positions, net.normals, net.shares_of(i), net.tiny);
  };
  const bool has_sphere = net.spheres.on() && !links.empty() && !links.front().start();
  NodeForce force = has_sphere ? from_neighbours(std::false_type()) : from_neighbours(std::true_type());
  if (has_sphere) force.spring = sphere_force(net, i) * net.normals[i];
  if (net.homes.empty()) return force;
  const Vector3 home = net.homes[i] - net.positions[i];
  const Vector3 across = home - home.dot(net.normals[i]) * net.normals[i];
  force.regularisation = (force.regularisation + across) / regularisation_divisor(net);
  return force;
}

}  // namespace vspring
