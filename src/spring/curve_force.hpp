#pragma once

// V-Spring for curves, in the whole normal plane (§4.8: "along both N_i and B_i").
//
// Let R be the rotation of least angle that takes T_i to T_j: it carries a frame along the edge without spin. Eq. 4 for
// any normal N of T_i and its companion R N is N·(d + Rᵀd)/(1 + T_i·T_j), where d = P_j − P_i; so the displacement of
// node i by node j is the part of d + Rᵀd across T_i, over 1 + T_i·T_j, whatever frame is chosen. On a planar curve
// that is Eq. 5 with the in-plane normals, through straight runs and inflections too.

#include <Eigen/Geometry>
#include <cmath>
#include <span>

#include "shape/fan.hpp"
#include "spring/v_spring.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Displacement of node i by its neighbour j. Zero where the tangents are opposite: no least rotation joins them.
inline Vector3 curve_spring(const Vector3& d, const Vector3& tangent_i, const Vector3& tangent_j) {
  const double denominator = 1 + tangent_i.dot(tangent_j);
  if (!(denominator > 1e-12)) return Vector3::Zero();
  // Rᵀ turns about the same axis by the opposite angle; Rodrigues' formula with sin and cos from cross and dot product.
  const Vector3 axis = tangent_j.cross(tangent_i);
  const Vector3 turned = (denominator - 1) * d + axis.cross(d) + axis * (axis.dot(d) / denominator);
  const Vector3 sum = d + turned;
  return (sum - sum.dot(tangent_i) * tangent_i) / denominator;
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

/// The average of the displacements spring(k, d) by the nodes k at the other ends of the links, and the regularisation
/// along the tangent: to the mean of the neighbours (§4.4), or, with shares, to where the lengths of the edges before
/// and after are as their opposite shares. A node without a tangent (zero) goes to the mean of its neighbours.
/// tiny: as for node_force().
template <typename Weight, typename Positions, typename Spring>
NodeForce curve_force(std::size_t i, std::span<const Link> links, const Positions& positions, const Vector3& tangent,
                      std::span<const double> shares, double tiny, const Spring& spring) {
  const Vector3& centre = positions[i];
  NodeForce force;
  if (links.empty()) return force;
  double weights = 0;
  double along = 0;
  Vector3 springs = Vector3::Zero();
  Vector3 mean = Vector3::Zero();
  const double even = 1 / static_cast<double>(links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::size_t j = links[k].node();
    const Vector3 d = positions[j] - centre;
    const double length = std::sqrt(d.dot(d) + tiny);
    const double weight = Weight::of(length);
    weights += weight;
    springs += weight * spring(j, d);
    mean += even * d;
    if (!shares.empty()) along += links[k].start() ? -shares[k] * length : shares[k] * length;
    force.mean_edge += even * length;
  }
  if (!(tangent.dot(tangent) > 0)) {
    force.regularisation = mean;
    return force;
  }
  force.spring = springs / weights;
  force.regularisation = (shares.empty() ? mean.dot(tangent) : along) * tangent;
  return force;
}

}  // namespace vspring
