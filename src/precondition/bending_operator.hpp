#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/level_matrix.hpp"
#include "linear/sparse_rows.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The derivative of V-Spring, up to a factor, on a surface with small slopes: forces are F ≈ −κ D⁻¹ B h for
/// displacements h along the normals, with B = Lᵀ D L + C over the moving nodes and D the sums of w = 1/ℓ over a node's
/// edges. A row of L is a node's mean curvature: Σ s_j h_j − h_i, with shares s near w_j / Σ w that take linear
/// functions in the tangent plane to zero, as V-Spring does. C has the terms of all other nodes than moving inner ones:
/// a node with a given normal bends against each edge separately; a held node with a computed normal bends like a
/// moving node, unless it lies on the boundary; a moving boundary node bends along the boundary only. B = Gᵀ G with G =
/// [√D L; the roots of C's terms]: first a row for every moving node, empty if C has its terms, then the rows of C.
/// Returns B, with `pull` added to its diagonal (empty: nothing). Cost: linear in the moving nodes.
SparseRows bending_operator(const Net& net, ThreadTeam& team, std::span<const double> pull = {});

/// B as a product Gᵀ G. The net must outlive it.
FactoredMatrix factored_bending_operator(const Net& net, ThreadTeam& team, std::span<const double> pull = {});

/// The residual r of the form, along the normals of moving nodes, after displacements `ways` of all nodes: a further
/// displacement h with B h = r undoes the bending. Cost: linear.
std::vector<double> bending_residual(const Net& net, std::span<const Vector3> ways);

/// D, the sum of 1/ℓ over the edges of every moving node, by their present lengths.
void sum_edge_weights(const Net& net, ThreadTeam& team, std::vector<float>& sums);

/// Whether nodes that slide stay where they are, as held ones do, or move as all others.
enum class SlidingNodes : std::uint8_t { stay, move };

/// The Laplacian of the moving nodes' graph with weights of one, for the regularisation (§4.4). shift: added to the
/// diagonal, as a share of it, so that a net without held nodes has a factor. Nodes that stay have rows and columns of
/// their own.
SparseRows tangential_laplacian(const Net& net, ThreadTeam& team, double shift = 1e-13,
                                SlidingNodes sliding = SlidingNodes::stay);

}  // namespace vspring
