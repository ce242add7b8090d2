#pragma once

#include <vector>

#include "curve_fit/curve_program.hpp"
#include "curve_fit/way.hpp"

namespace vspring {

/// Adds a first curve through a chain. Equal rows, and rows closer together than twice the noise, become one; a few
/// rows back and forth are reordered; nodes are as dense as the bends need. points: gets the points of the chain's own
/// nodes, with their places. The middle one of the rows at a found corner is its node.
void add_start(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, DenseCurve& curve,
               std::vector<CurvePoint>& points);

/// The curve with nodes anew at their spacing; no edge turns by more than 0.3 radians unless it is shorter than
/// `least`.
DenseCurve with_new_nodes(const DenseCurve& curve, double least);

/// Moves the curve to the smoothest spline, by third differences, with no point further than `within` from its place,
/// or with a root mean square distance of at most `rms`; the other is 0.
void smooth_out(DenseCurve& curve, const std::vector<CurvePoint>& points, double within, double rms);

/// Moves the curve to the smoothing spline of a smoothing length.
void smooth_out_by(DenseCurve& curve, const std::vector<CurvePoint>& points, double length);

struct LeastRisk {
  double rms = 0;  ///< root mean square distance of the points
  double smoothing = 0;
};

/// Moves the curve to the smoothing spline with the least expected distance from points without noise, by Mallows' C_p
/// (Stein's unbiased estimate of the risk). noise: standard deviation of the points in each direction across;
/// directions: their number. about: the smoothing of a similar curve, near which to search; 0: anywhere.
LeastRisk smooth_out_by_risk(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise, int directions,
                             double about);

/// Moves the curve to a robust smoothing spline, by absolute distances in place of squares, so outliers do not draw it
/// aside: the smoothest one with half of the points as near as noise of that standard deviation leaves them.
void smooth_out_robustly(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise);

/// Moves the place of each point to the nearest one around it.
void find_places(const DenseCurve& curve, std::vector<CurvePoint>& points);
/// Carries places over to the curve with new nodes.
void carry_places(const DenseCurve& before, const DenseCurve& curve, std::vector<CurvePoint>& points);

}  // namespace vspring
