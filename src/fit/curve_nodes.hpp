#pragma once

#include <vector>

#include "curve_fit/curve_fitter.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/resample.hpp"

namespace vspring {

/// How the nodes of a file are placed on a curve that was drawn to points.
struct NodePlacing {
  bool own_points = false;  ///< they are the points, and go to the nearest places
  bool even = true;         ///< else evenly between those that stay, or with the shares of the input's edges
};

/// Where the nodes of a file lie on a curve, in the curve's coordinates, in the order of its chains. Those that are
/// nodes of the curve have its places; of no chain: left as they are in `places`.
void place_nodes(const PolygonCurve& file, const CurveFound& found, NodePlacing how, std::vector<Vector3>& places);

/// Where a curve turns most, among places where it turns by more than 45° within the spacing of new nodes: chords would
/// cut these bends off. unit: of the curve's lengths in those of the input.
std::vector<Index> tight_bends(const DenseCurve& curve, const Resampling& how, double unit);

}  // namespace vspring
