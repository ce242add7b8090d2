#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// What of, of curvature.
enum class LeastVariation { in_proportion, in_all };

/// Where the nodes of a curve in a plane go, along their normals, to be the curve within a tolerance of all points
/// whose curvature changes most evenly in proportion to itself: of least Σ Δκ² / (Δs (κ + κ̄/2)²) over neighbouring
/// nodes, κ̄ the mean and κ that of the start where it is bent most nearby. So a nose may turn at once, and does not
/// swing beside it, as curves of least bending or least variation do. Ends are as free as all of it, not without
/// curvature. Where it has more extremes of curvature than most_extremes, the least are taken out, one after the other,
/// as long as there are such curves within the tolerance.
///
/// LeastVariation::in_all is that without the proportion: less of it where nodes are few, but curvature swings beside a
/// nose.
///
/// None where curve and points lie in no plane, an edge has no length, a normal is given, nothing is found within the
/// tolerance, or somebody has cancelled. start: of about the shape. Distances are those of the points from the edges.
/// By some 3 to 30 solutions of a BandProgram. Cost: linear in nodes and points but for the search of nearest edges.
std::optional<std::vector<Vector3>> gentle_curve(const PolygonCurve& start, const Constraints& constraints,
                                                 std::span<const Vector3> points, double tolerance,
                                                 std::size_t most_extremes, Context& context,
                                                 LeastVariation least = LeastVariation::in_proportion);

}  // namespace vspring
