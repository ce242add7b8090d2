#pragma once

// V-Spring for curves, in the whole normal plane (§4.8: "along both N_i and B_i").
//
// Let R be the rotation that carries a frame along the edge from i to j without spin, and T_i to T_j (double
// reflection: W. Wang, B. Jüttler, D. Zheng, Y. Liu, "Computation of rotation minimizing frames", ACM Trans. Graph.
// 27(1), 2008). Eq. 4 for a normal N of T_i and its companion R N is N·(d + Rᵀd)/(1 + T_i·T_j), where d = P_j − P_i; so
// the displacement of node i by node j is the part of d + Rᵀd across T_i, over 1 + T_i·T_j, whatever frame is chosen.
// This is (b_i − Rᵀ b_j)/(1 + T_i·T_j), where b_i is the part of d across T_i, and b_j the part of −d across T_j. On a
// planar curve it is Eq. 5 with the in-plane normals, also through straight runs and inflections. With the circle's
// tangent b_i = (ℓ²/2) k_i, k the curvature vector.

#include <Eigen/Geometry>
#include <cmath>
#include <span>

#include "shape/fan.hpp"
#include "spring/net.hpp"
#include "spring/v_spring.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Carries a vector along an edge d (or −d) without spin, from the end with tangent `from` to the end with tangent
/// `to`.
inline Vector3 carried(const Vector3& vector, const Vector3& d, const Vector3& from, const Vector3& to) {
  const double factor = 2 / d.dot(d);
  Vector3 mirrored = vector - (factor * d.dot(vector)) * d;
  const Vector3 mirror = to - from + (factor * d.dot(from)) * d;
  const double length2 = mirror.dot(mirror);
  // If the mirrored tangent equals the other one already, nothing remains to rotate.
  if (length2 > 1e-24) mirrored -= (2 * mirror.dot(mirrored) / length2) * mirror;
  return mirrored;
}

/// Displacement of node i by its neighbour j, with d = P_j − P_i not zero. bend_i: the part of d across T_i; bend_j:
/// the part of −d across T_j. Zero if the tangents are opposite: then no rotation without spin is defined.
inline Vector3 curve_spring(const Vector3& bend_i, const Vector3& bend_j, const Vector3& d, const Vector3& tangent_i,
                            const Vector3& tangent_j) {
  const double denominator = 1 + tangent_i.dot(tangent_j);
  if (!(denominator > 1e-12)) return Vector3::Zero();
  return (bend_i - carried(bend_j, d, tangent_j, tangent_i)) / denominator;
}

/// The part of d, an edge from node i, across the tangent of i. If the tangent is that of the circle it is taken from
/// the curvature, which is more precise.
inline Vector3 bend(const Net& net, std::size_t i, const Vector3& d) {
  if (!net.curvatures.empty() && net.given[i] == 0) return (0.5 * d.dot(d)) * net.curvatures[i];
  const Vector3& tangent = net.tangents[i];
  return d - d.dot(tangent) * tangent;
}

/// Displacement of node i of a net by its neighbour j.
inline Vector3 curve_spring(const Net& net, std::size_t i, std::size_t j) {
  const Vector3 d = net.positions[j] - net.positions[i];
  if (!(d.dot(d) > net.tiny)) return Vector3::Zero();
  return curve_spring(bend(net, i, d), bend(net, j, -d), d, net.tangents[i], net.tangents[j]);
}

/// Calls use(spring, d) once for every edge whose springs depend on moving nodes: edges of moving nodes, and edges
/// between held neighbours of moving nodes, whose curvature they change.
template <typename Use>
void for_each_curve_spring(const Net& net, const Use& use) {
  for (std::size_t i = 0; i < net.computed; ++i) {
    for (const Link link : net.rings.links(i)) {
      const std::size_t j = link.node();
      const bool comes_later = j > i && (i < net.moving || j < net.computed);
      if (comes_later) use(curve_spring(net, i, j), Vector3(net.positions[j] - net.positions[i]));
    }
  }
}

/// 1/ℓ³: t_j − t_i is about −(ℓ³/12) times the derivative of the curvature towards j, so equal weights to equal
/// derivatives need its inverse; with the paper's 1/ℓ the equilibrium depends on the spacing.
struct InverseCubeWeight {
  static double of(double length) { return 1 / (length * length * length); }
};

/// The paper's weight.
struct InverseWeight {
  static double of(double length) { return 1 / length; }
};

/// The average of the displacements spring(j) by the neighbours j of node i, and the regularisation along the tangent.
/// This moves the node to the mean of its neighbours (§4.4), with shares to where the edges before and after are as
/// long as the opposite shares, with targets to the target. A node without a tangent (zero) goes to the mean of its
/// neighbours.
template <typename Weight, typename Spring>
NodeForce curve_force(const Net& net, std::size_t i, const Spring& spring) {
  const auto links = net.rings.links(i);
  const auto shares = net.weights_of(i);
  const Vector3& tangent = net.tangents[i];
  NodeForce force;
  if (links.empty()) return force;
  double weights = 0;
  double along = 0;
  Vector3 springs = Vector3::Zero();
  Vector3 mean = Vector3::Zero();
  const double even = 1 / static_cast<double>(links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::size_t j = links[k].node();
    const Vector3 d = net.positions[j] - net.positions[i];
    const double length = std::sqrt(d.dot(d) + net.tiny);
    const double weight = Weight::of(length);
    weights += weight;
    springs += weight * spring(j);
    mean += even * d;
    if (!shares.empty()) along += links[k].start() ? -shares[k] * length : shares[k] * length;
    force.mean_edge += even * length;
  }
  if (!(tangent.dot(tangent) > 0)) {
    force.regularisation = mean;
    return force;
  }
  force.spring = springs / weights;
  if (!net.target_positions.empty())
    along = (net.target_positions[i] - net.positions[i]).dot(tangent);
  else if (shares.empty())
    along = mean.dot(tangent);
  force.regularisation = along * tangent;
  return force;
}

}  // namespace vspring
