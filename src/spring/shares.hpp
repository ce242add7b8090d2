#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Of all shares of sum 1 that leave a node in its place among its neighbours, across the normal, those nearest to even
/// ones: share_j = 1/m − (d_j − mean)·a. Aligned with the links of the node, zero where a link is no spoke. Shares of a
/// node outside its neighbours are partly negative.
void even_shares(const Net& net, std::size_t i, const Vector3& normal, std::span<const Vector3> places,
                 std::span<double> shares);

/// Of a node of a curve: an edge counts as the other one is long.
void share_by_length(const Net& net, std::size_t i, std::span<const Vector3> places, std::span<double> shares);

/// What every link counts in the regularisation (§4.4) so that all nodes are where they are sent when they lie as at
/// `places`, in the plane across their normal there: the geometric mean of mean value coordinates (M. S. Floater, "Mean
/// value coordinates", Comput. Aided Geom. Des. 20(1), 2003) and of shares by the inverse squares of distances, made to
/// leave nodes in their places, none below a quarter, on a coarse level 0.8, of what the inverse squares would make it.
/// By mean value coordinates alone neighbours along the long side of wide cells count so much that a row that is bent
/// otherwise than at `places` pulls its nodes off by many rows. Aligned with the links of the net, of sum 1 over the
/// spokes. Nodes on a free boundary, which lie outside their neighbours, have the shares nearest to even ones. Cost:
/// linear; the same result on any number of threads.
std::vector<double> laplacian_weights_at(const Net& net, std::span<const Vector3> places, ThreadTeam& team,
                                         bool coarse = false);

}  // namespace vspring
