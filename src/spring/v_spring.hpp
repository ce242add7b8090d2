#pragma once

// The forces on one node: V-Spring (§3, Eqs. 4, 5, 8) and the regularisation of the node distribution (§4.4).

#include <algorithm>
#include <cmath>
#include <span>

#include "shape/fan.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Eq. 4: t_j − t_i, the difference of the spring lengths of two nodes, from d = P_j − P_i and the unit normals. If the
/// normals are more than 90° apart, N_j is reversed. At most √2 |d|.
inline double spring_difference(const Vector3& d, const Vector3& normal_i, const Vector3& normal_j) {
  const double cosine = normal_i.dot(normal_j);
  const double along_j = d.dot(normal_j);
  return (d.dot(normal_i) + (cosine < 0 ? -along_j : along_j)) / (1 + std::abs(cosine));
}

/// spring_difference() without its jump: within 3.6° of a right angle N_j is reversed gradually, as a force that jumps
/// may have no equilibrium.
inline double steady_difference(const Vector3& d, const Vector3& normal_i, const Vector3& normal_j) {
  constexpr double steepness = 16;
  const double cosine = normal_i.dot(normal_j);
  const double sense = std::clamp(steepness * cosine, -1.0, 1.0);
  return (d.dot(normal_i) + sense * d.dot(normal_j)) / (1 + std::abs(cosine));
}

/// Which springs a node has.
enum class SpringKind {
  steady,   ///< Eq. 4 by steady_difference()
  printed,  ///< by spring_difference()
  other     ///< no springs of Eq. 8
};

/// The force on a node.
struct NodeForce {
  Vector3 spring = Vector3::Zero();          ///< dP_i of Eq. 8, along the normal; with points + dPc_i
  Vector3 regularisation = Vector3::Zero();  ///< dPu_i of §4.4, across the normal
  double mean_edge = 0;                      ///< mean length of the node's edges
  /// Of the points tied to the node: by how much dPc_i falls per length that the node moves along it.
  double stiffness = 0;
};

/// Eq. 8 with w_j = 1/‖P_i − P_j‖, and §4.4. A node without a normal (zero) has no spring force and goes to the mean of
/// its neighbours. shares: of each link in that mean, aligned with links and of sum 1 over the spokes; empty: equal.
/// tiny: added to squared lengths, so an edge of length zero has a finite weight.
template <SpringKind kind = SpringKind::steady, typename Positions>
NodeForce node_force(std::size_t i, std::span<const Link> links, const Positions& positions, const Positions& normals,
                     std::span<const double> shares, double tiny) {
  const Vector3& centre = positions[i];
  const Vector3& normal = normals[i];
  double weights = 0;
  double differences = 0;
  double lengths = 0;
  double spokes = 0;
  Vector3 mean = Vector3::Zero();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    const std::size_t j = links[k].node();
    const Vector3 d = positions[j] - centre;
    const double length = std::sqrt(d.dot(d) + tiny);
    if constexpr (kind != SpringKind::other) {
      const double weight = 1 / length;
      weights += weight;
      differences += weight * (kind == SpringKind::printed ? spring_difference(d, normal, normals[j])
                                                           : steady_difference(d, normal, normals[j]));
    }
    lengths += length;
    spokes += 1;
    mean += shares.empty() ? d : Vector3(shares[k] * d);
  }
  NodeForce force;
  if (spokes == 0) return force;
  if (shares.empty()) mean /= spokes;
  if constexpr (kind != SpringKind::other) force.spring = differences / weights * normal;
  force.regularisation = mean - mean.dot(normal) * normal;
  force.mean_edge = lengths / spokes;
  return force;
}

}  // namespace vspring
