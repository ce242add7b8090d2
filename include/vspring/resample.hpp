#pragma once

#include <optional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// How the nodes of a resampled curve follow each other between those that are kept.
enum class ResamplingBy {
  length,    ///< evenly
  cosine,    ///< as tables of aerofoils have them: close at both ends and where the piece is furthest from them
  curvature  ///< so that arcs rise about equally over their chords: closer where the curve is bent more
};

/// How many nodes a resampled curve gets, one of the two, and where.
struct Resampling {
  /// In all; pieces between kept nodes get them by their lengths, as nearly as whole numbers allow.
  std::optional<Index> nodes = std::nullopt;
  /// Between neighbours, in units of the curve, as nearly as the lengths of pieces allow; the mean where nodes are not
  /// even.
  std::optional<double> spacing = std::nullopt;
  ResamplingBy by = ResamplingBy::length;
};

struct Resampled {
  PolygonCurve curve;
  Constraints constraints;
  std::vector<Index> from;  ///< for every node its number in the input, −1 for new ones
};

/// New nodes along a curve. Ends, nodes where chains meet, and nodes that `constraints` says anything of are kept,
/// where the constraints have them; pieces between them are replaced by nodes on the cubics through the nodes with the
/// tangents of estimate_tangents(). A closed chain without kept nodes keeps its first. Nodes come in the order of the
/// chains; those of no chain are left out.
///
/// Throws Error(invalid_argument) unless one of the two is given, greater than 0, asks for no more than 100 million
/// nodes, and for a number of nodes too small for the pieces; Error(unusable_shape) for a chain with a coordinate that
/// is not finite. Cost: linear in the nodes before and after.
[[nodiscard]] Resampled resample(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how);

}  // namespace vspring
