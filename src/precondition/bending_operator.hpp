#pragma once

#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/level_matrix.hpp"
#include "linear/sparse_rows.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The derivative of V-Spring on a surface where slopes are small, up to a factor: forces are F ≈ −κ D⁻¹ B h for
/// displacements h along the normals, with B = Lᵀ D L + C over the moving nodes and D the sums of w = 1/ℓ over a node's
/// edges. A row of L is a node's mean curvature: Σ s_j h_j − h_i with shares s near w_j / Σ w that take linear
/// functions of the place in the tangent plane to zero, as V-Spring does. C holds what is none of a moving node inside:
/// a node with a given normal bends against each edge by itself; a held node with a computed one bends like a moving
/// node, unless it lies on the boundary; a moving node there bends along the boundary only.
/// B = Gᵀ G with G = [√D L; the roots of C's terms]: first a row for every moving node, which is empty where C has the
/// rest, then those of C.
/// Returns B, with `pull` added to its diagonal (empty: nothing). Cost: linear in the moving nodes.
SparseRows bending_operator(const Net& net, ThreadTeam& team, std::span<const double> pull = {});

/// B as the product that it is. The net must outlive it.
FactoredMatrix factored_bending_operator(const Net& net, ThreadTeam& team, std::span<const double> pull = {});

/// What the form asks of the moving nodes, along their normals, where all nodes have gone such ways, a vector each: to
/// go on by h with B h = that undoes the bending. Cost: linear.
std::vector<double> bending_residual(const Net& net, std::span<const Vector3> ways);

/// D, the sum of 1/ℓ over the edges of every moving node, by the lengths that they have now.
void sum_edge_weights(const Net& net, ThreadTeam& team, std::vector<float>& sums);

/// The Laplacian of the moving nodes' graph with weights of one: what the regularisation (§4.4) spreads nodes by.
/// shift: what is added to the diagonal, as a share of it; keeps a net that nothing holds from having no factor.
SparseRows tangential_laplacian(const Net& net, ThreadTeam& team, double shift = 1e-13);

}  // namespace vspring
