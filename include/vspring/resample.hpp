#pragma once

#include <optional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"

namespace VSPRING_API vspring {

/// How new nodes are spaced between kept ones.
enum class ResamplingBy {
  length,    ///< evenly
  cosine,    ///< as in tables of aerofoils: closer at both ends of a piece and where it is furthest from them
  curvature  ///< closer where the curve is bent more, so that all arcs rise about equally over their chords
};

/// How many nodes a resampled curve gets (nodes or spacing, exactly one of them), and how they are spaced.
struct Resampling {
  /// Number of nodes in all. Pieces between kept nodes share them by length, as nearly as whole numbers allow.
  std::optional<Index> nodes = std::nullopt;
  /// Mean distance between neighbours, in units of the curve, as nearly as the lengths of pieces allow.
  std::optional<double> spacing = std::nullopt;
  /// How nodes are spaced.
  ResamplingBy by = ResamplingBy::length;
  /// Nodes that are kept and at which the curve's direction may jump, besides the corners of the constraints.
  std::vector<Index> corners = {};
};

/// A curve with new nodes.
struct Resampled {
  PolygonCurve curve;       ///< with its chains
  Constraints constraints;  ///< those of the kept nodes; new ones are free
  std::vector<Index> from;  ///< for every node its number in the input, −1 for new ones
};

/// Puts new nodes along a curve. It keeps ends, corners, nodes where chains meet, and nodes with a constraint, at the
/// position that this gives; a closed chain without any of these keeps its first node. Between kept nodes the old ones
/// are replaced by new nodes on the cubics through the old nodes with the tangents of estimate_tangents(). Nodes come
/// in the order of the chains; nodes of no chain are left out.
///
/// Throws Error(invalid_argument) unless exactly one of nodes and spacing is given and is greater than 0, for more than
/// 100 million nodes, for fewer nodes than the pieces need, and for a corner that is no node; Error(unusable_shape) for
/// a chain with a coordinate that is not finite; what check_constraints() throws for corners. Cost: linear in the nodes
/// before and after.
[[nodiscard]] Resampled resample(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how);

}  // namespace vspring
