#pragma once

#include <vector>

#include "curve_fit/curve_program.hpp"
#include "curve_fit/way.hpp"

namespace vspring {

/// Half of what noise of a standard deviation of 1 leaves, across, is below this.
inline constexpr double median_of_noise = 0.6745;

/// A first curve through a chain: equal rows and those closer together than twice the noise are one; a few rows back
/// and forth are brought into order; nodes come as dense as the bends of that ask for. points: those of the chain's own
/// nodes, at their places, are added. Of the rows at a corner that is found the middle one is its node.
void add_start(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, DenseCurve& curve,
               std::vector<CurvePoint>& points);

/// The same curve with nodes as far apart as their spacing says, and no edge that turns by more than 0.3 unless it is
/// shorter than `least`.
DenseCurve with_new_nodes(const DenseCurve& curve, double least);

/// Goes to the smoothing spline, by third differences, that is as smooth as it can be with no point further than
/// `within` from its place, or not further in the root mean square than `rms`; the other is 0.
void smooth_out(DenseCurve& curve, const std::vector<CurvePoint>& points, double within, double rms);

/// The same for a smoothing length.
void smooth_out_by(DenseCurve& curve, const std::vector<CurvePoint>& points, double length);

struct LeastRisk {
  double rms = 0;  ///< what points are off
  double smoothing = 0;
};

/// The same as smooth as it takes for the expected distance from where points without noise would lie to be least, by
/// Mallows' C_p (Stein's unbiased estimate of the risk). noise: their standard deviation in each of so many directions
/// across. about: the smoothing of a curve that is much the same, near which this one's is then looked for; 0:
/// anywhere.
LeastRisk smooth_out_by_risk(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise, int directions,
                             double about);

/// The same by absolute distances in place of squares, which single points that are off do not draw aside: as smooth as
/// it can be with half of the points as near as noise of that standard deviation leaves them.
void smooth_out_robustly(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise);

/// Each to the nearest place about where it was. other: the curve on which they have places; may be the same.
void find_places(const DenseCurve& curve, std::vector<CurvePoint>& points);
/// Of places on a curve that has got new nodes since.
void carry_places(const DenseCurve& before, const DenseCurve& curve, std::vector<CurvePoint>& points);

}  // namespace vspring
