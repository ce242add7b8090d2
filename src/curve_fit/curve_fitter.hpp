#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "curve_fit/curve_start.hpp"

namespace vspring {

/// How far points, and places of a curve from the polyline of the points, may be: in root mean squares of all points.
inline constexpr double reach_of_rms = 3;

struct CurveFound {
  DenseCurve curve;
  std::vector<CurvePoint> points;  ///< with their places; scattered ones last
  /// The line through scattered points in their order along the given curve; in gaps it goes through the curve's nodes,
  /// moved along with the points next to them.
  std::vector<CurvePoint> way;
  bool converged = false;
  double greatest = 0;  ///< greatest distance of a point
  double rms = 0;
  double beyond = 0;     ///< greatest distance of the curve from the polyline, as a share of its bound
  double smoothing = 0;  ///< the smoothing length, if one was given
  int steps = 0;
  std::size_t work = 0;  ///< number of nodes, summed over all steps
  double error = 0;      ///< length of the last step
};

/// Chains and the points to draw them to, in coordinates in which all has size 1.
struct CurveFitTask {
  struct Chain {
    std::vector<ChainNode> nodes;
    bool closed = false;
  };
  std::vector<Chain> chains;
  /// Points that are no nodes of the chains.
  std::vector<CurvePoint> scattered;
  /// In place of chains: nodes whose chords are the curve, on which the scattered points and the way have places.
  const DenseCurve* nodes = nullptr;
  std::vector<CurvePoint> way;  ///< of scattered points, as found before; with `nodes`
  /// The result of start_of(), if it was called for the same task; evenly, spare and least_radius may differ.
  const CurveFound* start = nullptr;
  bool in_order = true;          ///< whether points come in the order of the chains
  std::optional<Vector3> plane;  ///< the normal of the plane in which everything lies, if any
  /// 1 for coordinates that may change, 0 for others: one in a plane, or two in space.
  Vector3 moving = Vector3::Ones();
  // Exactly one of these four is given; the others are 0.
  double within = 0;
  /// Per point the part of `within` that chords exceed, which the curve must leave free. Empty: zero.
  std::vector<double> spare;
  double way_share = 1;  ///< share of the allowed distance from the polyline for the curve; the rest is for its chords
  double rms = 0;
  double smoothing = 0;
  /// The paper's k (Eq. 9), for this many edges of even lengths.
  double weight = 0;
  double edges = 1;
  bool evenly = false;      ///< change of curvature counts equally everywhere, not less where curvature is large
  double noise = 0;         ///< of the points, across the curve
  double least_radius = 0;  ///< 0: any
  double sharp = 0;         ///< corners are where the points' way turns by more than this, in radians; 0: no corners
  double tolerance = 1e-5;  ///< how near to the fairest, a share of the size
  std::size_t most_work = std::numeric_limits<std::size_t>::max();  ///< when exceeded, the present curve is returned
};

/// The distances of a task's points from a robust curve through them, in standard deviations estimated from the nearer
/// half, with the points' numbers: first the task's own nodes, in order, then the scattered ones.
std::vector<std::pair<Index, double>> robust_deviations(const CurveFitTask& task);

/// The smoothing spline that is expected to be nearest to the points without their noise, of the task's standard
/// deviation. Its `rms` is what noise leaves across it.
CurveFound curve_of_least_risk(const CurveFitTask& task);

/// The smooth curve near the points from which steps start, if a tolerance is given.
CurveFound start_of(const CurveFitTask& task);

/// Finds the fairest curve through a task's held nodes that its points allow: of least change of curvature within a
/// tolerance or a root mean square, or where springs and points balance. Each step is a convex program about the
/// present curve.
CurveFound fit_curve(const CurveFitTask& task, const std::function<void(double share)>& progress);

}  // namespace vspring
