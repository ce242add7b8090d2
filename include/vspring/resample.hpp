#pragma once

#include <optional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// How many nodes a resampled curve gets; one of the two.
struct Resampling {
  /// In all; pieces between kept nodes get them by their lengths, as nearly as whole numbers allow.
  std::optional<Index> nodes = std::nullopt;
  /// Between neighbours, in units of the curve, as nearly as the lengths of pieces allow.
  std::optional<double> spacing = std::nullopt;
};

struct Resampled {
  PolygonCurve curve;
  Constraints constraints;
  std::vector<Index> from;  ///< for every node its number in the input, −1 for new ones
};

/// Evenly spaced nodes along a curve. Ends, nodes where chains meet, and nodes that `constraints` says anything of are
/// kept, where the constraints have them; pieces between them are replaced by nodes of even spacing on the cubics
/// through the nodes with the tangents of estimate_tangents(). A closed chain without kept nodes keeps its first. Nodes
/// come in the order of the chains; those of no chain are left out.
///
/// Throws Error(invalid_argument) unless one of the two is given, greater than 0, asks for no more than 100 million
/// nodes, and for a number of nodes too small for the pieces; Error(unusable_shape) for a chain with a coordinate that
/// is not finite. Cost: linear in the nodes before and after.
[[nodiscard]] Resampled resample(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how);

}  // namespace vspring
