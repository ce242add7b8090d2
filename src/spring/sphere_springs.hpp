#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

class LinkEdges;
struct Net;

/// Springs of a surface that do not see which way edges run: that of a node is the radius of its mean-curvature sphere,
/// and neighbours' springs agree when their mean curvatures do. Of Eq. 4's difference along an edge, which is
/// ½|d|² (c_i − c_j) + ½(q_i − q_j)(d) where heights over a tangent plane are c|e|² + q(e), q without trace, this is
/// the first part.
struct SphereSprings {
  /// Half the mean curvature of every node, by its normal: what lies to the normal's side of the tangent plane is
  /// positive. Not a number where it is not known. Empty: springs are those of Eq. 4.
  std::vector<double> curvatures;
  /// Entries of the cotangent Laplacian, aligned with the links of the net. An n-gon counts as n triangles around the
  /// mean of its nodes.
  std::vector<double> stiffness;
  std::vector<double> areas;  ///< the node's share of the faces around it
  /// What forces are divided by in the linear equations, Σ 1/ℓ for springs of Eq. 4: 16 M/ρ⁴ of the node's area M and
  /// its mean squared edge ρ².
  std::vector<double> weights;
  /// H² − K of moving nodes, a quarter of the squared difference of their principal curvatures. Empty: the equilibrium
  /// is not that of least bending.
  std::vector<double> differences;
  double factor = 1;  ///< bending_factor() of the net

  [[nodiscard]] bool on() const noexcept { return !curvatures.empty(); }
};

/// Makes room in the net for sphere springs, which switches them on.
void use_sphere_springs(Net& net);

/// Makes the equilibrium of a net with sphere springs that of least bending.
void use_least_bending(Net& net);

/// How many nodes update_spheres() takes at most.
inline constexpr std::size_t spheres_together = 8;

/// What a node's row of the Laplacian is worth in a curvature.
struct RowSpread {
  double sum = 0;     ///< of its entries, raised, times squared edges
  double raised = 0;  ///< by how much they are raised, all alike: else the sum would be too little for the area
};

RowSpread spread_of_row(const Net& net, std::size_t i, const LinkEdges& edges);

/// Normals (where not given; `first` has a guess for each) and curvatures of nodes with rings, from node `begin` on,
/// from their links by least squares, and their rows of the Laplacian. Curvatures of nodes with given normals are left
/// to find_given_curvature(). The same however nodes are put together.
void update_spheres(Net& net, std::size_t begin, std::span<const Vector3> first);

/// Of a node whose normal is given; needs normals of its neighbours.
void find_given_curvature(Net& net, std::size_t i);

/// The force on a moving node inside, along its normal, as Eq. 8's but of sphere springs:
/// κ ρ⁴/(4 M) Σ K (c_i − c_j), where bending is to be least less κ ρ⁴/2 c (H² − K).
double sphere_force(const Net& net, std::size_t i);

}  // namespace vspring
