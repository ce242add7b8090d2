#pragma once

#include <memory>

#include "points/point_ties.hpp"

namespace vspring {

/// For points whose weights are shares of one pull on the whole shape: the sum of a node's weights times ℓ² on
/// surfaces, ℓ³ on curves (ℓ: the mean length of its edges). Then the balance with bending does not depend on the
/// number of nodes.
PointFactors pull_by_sums();

/// The power of ℓ in pull_by_sums().
double pull_power(const Net& net);

/// For the smoothing length λ. N points lie on the length or area A of the moving nodes. A node with n of them is
/// pulled by n (A/N) / (4 W λ⁴) on curves, W = Σ 1/ℓ³; on surfaces by κ ℓ⁴/16 n (A/N) / (a λ⁴), with its area a, the
/// mean square ℓ² of its edges and κ the bending_factor(). Weights of clusters are sums over their points. length: λ in
/// the coordinates of the net; may change later. points: N; 0: the points of moving nodes.
PointFactors pull_by_smoothing(std::shared_ptr<const double> length, std::size_t points = 0);

/// For the smoothing length λ, if the points are the surface's own nodes: κ ē⁴ / (16 λ⁴) at every node, ē the mean edge
/// of all. So smoothing lengths vary with the local edges, which scans have shorter where there is more detail.
PointFactors pull_by_edges(std::shared_ptr<const double> length);

}  // namespace vspring
