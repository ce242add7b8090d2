#pragma once

#include <memory>

#include "points/point_ties.hpp"

namespace vspring {

/// For points whose weights are shares of one pull on the whole shape, against what shapes bend by: the sum of a node's
/// weights times ℓ² on surfaces, ℓ³ on curves (ℓ the mean length of its edges), however many nodes there are.
PointFactors pull_by_sums();

/// The power of the length of edges in that.
double pull_power(const Net& net);

/// For the smoothing length λ: with N points on the length or area A of the moving nodes, a node with n of them, a
/// share a of the area and W = Σ 1/ℓ³ on curves pulls by n (A/N) / (4 W λ⁴), on surfaces by κ ℓ⁴/16 n (A/N) / (a λ⁴),
/// ℓ² the mean square of its edges and κ the bending_factor(). Where points are clusters, weights are sums over their
/// points. length: λ in the coordinates of the net, which may be changed. points: N; 0: those that moving nodes have.
PointFactors pull_by_smoothing(std::shared_ptr<const double> length, std::size_t points = 0);

/// The same of points that are the nodes of a surface themselves, by lengths that go with its edges, as scans have
/// shorter ones where there is more to see: κ ē⁴ / (16 λ⁴) at every node, ē the mean edge of all.
PointFactors pull_by_edges(std::shared_ptr<const double> length);

}  // namespace vspring
