#pragma once

#include <span>

#include "shape/node_graph.hpp"

namespace vspring {

// An extremum of curvature counts if it is visible: by more than this share of the root mean square, and more than the
// curvature of a radius of a thousand sizes.
inline constexpr double visible_share = 0.05;
inline constexpr double visible_curvature = 1e-3;

/// Counts the maxima of `values` at inner nodes whose persistence, the descent needed before a higher maximum can be
/// reached, exceeds `threshold` (H. Edelsbrunner, D. Letscher, A. Zomorodian, "Topological persistence and
/// simplification", Discrete Comput. Geom. 28, 2002).
///
/// used: nodes to consider. inside: nodes at which a maximum counts; other maxima only hide lower ones. Cost: n log n.
Index count_maxima(const NodeGraph& graph, std::span<const double> values, std::span<const std::uint8_t> used,
                   std::span<const std::uint8_t> inside, double threshold);

/// Counts the extrema of signed values along a line that exceed `threshold`. closed: the last value is followed by the
/// first.
Index count_extrema(std::span<const double> values, bool closed, double threshold);

/// Counts changes of sign, from beyond `threshold` on one side to beyond it on the other.
Index count_sign_changes(std::span<const double> values, bool closed, double threshold);

}  // namespace vspring
