#pragma once

#include <span>

#include "shape/node_graph.hpp"

namespace vspring {

// An extreme of curvature is one if it can be seen: more than this share of the root mean square, and more than a
// radius of a thousand times the size.
inline constexpr double visible_share = 0.05;
inline constexpr double visible_curvature = 1e-3;

/// The number of nodes inside where `values` have a maximum that stands out by more than `threshold`: by its
/// persistence, the way down before a higher maximum can be climbed (H. Edelsbrunner, D. Letscher, A. Zomorodian,
/// "Topological persistence and simplification", Discrete Comput. Geom. 28, 2002).
///
/// used: nodes that are looked at. inside: nodes at which a maximum counts; others only hide lower ones.
/// Cost: n log n.
Index count_maxima(const NodeGraph& graph, std::span<const double> values, std::span<const std::uint8_t> used,
                   std::span<const std::uint8_t> inside, double threshold);

/// Where signed values along a line turn back by more than `threshold`. closed: the last value is followed by the
/// first.
Index count_extrema(std::span<const double> values, bool closed, double threshold);

/// Where they change sign, from beyond `threshold` on one side to beyond it on the other.
Index count_sign_changes(std::span<const double> values, bool closed, double threshold);

}  // namespace vspring
