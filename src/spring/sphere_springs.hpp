#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

class LinkEdges;
struct Net;

/// Springs of a surface that do not depend on the directions of edges. A node's spring is the radius of its
/// mean-curvature sphere; neighbours' springs agree if their mean curvatures do. With heights over a tangent plane
/// c|e|² + q(e), q without trace, Eq. 4's difference along an edge is ½|d|² (c_i − c_j) + ½(q_i − q_j)(d); sphere
/// springs keep its first part.
struct SphereSprings {
  /// Half the mean curvature of every node, positive if the surface bends towards its normal. NaN if unknown. Empty:
  /// springs are those of Eq. 4.
  std::vector<double> curvatures;
  /// Entries of the cotangent Laplacian, aligned with the links of the net. An n-gon counts as n triangles around the
  /// mean of its nodes.
  std::vector<double> stiffness;
  std::vector<double> areas;  ///< the node's share of the faces around it
  /// Divisors of forces in the linear equations: 16 M/ρ⁴, with the node's area M and its mean squared edge ρ² (Σ 1/ℓ
  /// for springs of Eq. 4).
  std::vector<double> weights;
  /// H² − K of moving nodes, a quarter of the squared difference of their principal curvatures. Empty unless the
  /// equilibrium is that of least bending.
  std::vector<double> differences;
  double factor = 1;  ///< bending_factor() of the net

  [[nodiscard]] bool on() const noexcept { return !curvatures.empty(); }
};

/// Allocates sphere springs in the net, which switches them on.
void use_sphere_springs(Net& net);

/// Makes the equilibrium of a net with sphere springs that of least bending.
void use_least_bending(Net& net);

/// Most nodes that update_spheres() takes at once.
inline constexpr std::size_t spheres_together = 8;

/// Sums of a node's row of the Laplacian, for its curvature.
struct RowSpread {
  double sum = 0;     ///< of its entries, raised by `raised`, times squared edges
  double raised = 0;  ///< added to every entry, so that the sum is large enough for the area
};

RowSpread spread_of_row(const Net& net, std::size_t i, const LinkEdges& edges);

/// Computes normals (unless given; `first` has a guess for each) and curvatures of nodes with rings, from node `begin`
/// on, by least squares over their links, and their rows of the Laplacian. Curvatures of nodes with given normals are
/// left to find_given_curvature(). Results do not depend on how nodes are grouped.
void update_spheres(Net& net, std::size_t begin, std::span<const Vector3> first);

/// Finds the curvature of a node whose normal is given; needs the normals of its neighbours.
void find_given_curvature(Net& net, std::size_t i);

/// The force of sphere springs on a moving inner node, along its normal, in place of Eq. 8: κ ρ⁴/(4 M) Σ K (c_i − c_j);
/// for least bending minus κ ρ⁴/2 c (H² − K). Likewise on one that slides at a boundary: there the sum over the faces
/// on one side vanishes where the mean curvature does not change across the boundary, on any mesh (the weak form of the
/// Laplacian has that natural condition).
double sphere_force(const Net& net, std::size_t i);

}  // namespace vspring
