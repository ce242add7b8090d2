#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The shares nearest to equal ones among those of sum 1 that keep a node in its place across the normal: share_j = 1/m
/// − (d_j − mean)·a. Aligned with the links of the node, zero if a link is no spoke. For a node outside its neighbours
/// some are negative.
void even_shares(const Net& net, std::size_t i, const Vector3& normal, std::span<const Vector3> places,
                 std::span<double> shares);

/// Shares of a node of a curve: those of its two neighbours are as the lengths of the opposite edges.
void share_by_length(const Net& net, std::size_t i, std::span<const Vector3> places, std::span<double> shares);

/// The share of every link in the regularisation (§4.4) that keeps nodes at `places`, in the plane across their normal
/// there. It is the geometric mean of mean value coordinates (M. S. Floater, "Mean value coordinates", Comput. Aided
/// Geom. Des. 20(1), 2003) and of shares by inverse squares of distances, corrected to keep nodes in their places; none
/// is below 0.25, on coarse levels 0.8, of that by inverse squares. With mean value coordinates alone, neighbours along
/// the long side of wide cells would count so much that a row bent otherwise than at `places` moved its nodes by many
/// rows. Aligned with the links of the net, of sum 1 over the spokes. Nodes on a free boundary, which lie outside their
/// neighbours, have the shares nearest to equal ones. Cost: linear; the same result on any number of threads.
std::vector<double> laplacian_weights_at(const Net& net, std::span<const Vector3> places, ThreadTeam& team,
                                         bool coarse = false);

}  // namespace vspring
