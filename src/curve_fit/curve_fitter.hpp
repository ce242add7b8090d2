#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "curve_fit/curve_start.hpp"

namespace vspring {

struct CurveFound {
  DenseCurve curve;
  std::vector<CurvePoint> points;  ///< with their places; those of scattered ones last
  /// Of scattered points: the line through them in their order along the given curve, and through the nodes of that
  /// where it has none, moved along with the points beside.
  std::vector<CurvePoint> way;
  bool converged = false;
  double greatest = 0;  ///< distance of the points
  double rms = 0;
  double beyond = 0;     ///< the greatest share of its bound that a place of the curve is away from the polyline
  double smoothing = 0;  ///< the smoothing length, where one was given
  int steps = 0;
  std::size_t work = 0;  ///< nodes, each for every step in which a program was solved
  double error = 0;      ///< how far the last step went
};

/// Chains and what they are drawn to, in coordinates in which all is of size 1.
struct CurveFitTask {
  struct Chain {
    std::vector<ChainNode> nodes;
    bool closed = false;
  };
  std::vector<Chain> chains;
  /// Those that are no nodes of the chains.
  std::vector<CurvePoint> scattered;
  /// In place of chains: nodes whose chords are the curve. The scattered points have places on them, and so has the
  /// way.
  const DenseCurve* nodes = nullptr;
  std::vector<CurvePoint> way;  ///< of scattered points, as it was found; where there are such nodes
  /// What start_of() returned, if it was called: of a task that is the same but for evenly, spare and least_radius.
  const CurveFound* start = nullptr;
  bool in_order = true;          ///< whether points come in the order of the chains
  bool keeps_way = true;         ///< whether the curve is held near the polyline through them
  std::optional<Vector3> plane;  ///< its normal, where all lies in one
  /// 1 for coordinates that move, 0 for others: one in a plane, or two in space.
  Vector3 moving = Vector3::Ones();
  // One of these; the others are 0.
  double within = 0;
  /// What of it is not for the curve, by the number of the point: so much chords go beyond. Empty: nothing.
  std::vector<double> spare;
  double way_share = 1;  ///< of how far the curve may go from the polyline: the rest is for its chords
  double rms = 0;
  double smoothing = 0;
  /// The paper's k (Eq. 9), for so many edges of even lengths.
  double weight = 0;
  double edges = 1;
  bool evenly = false;      ///< change of curvature counts alike everywhere, not less where it is large
  double noise = 0;         ///< of the points, across
  double least_radius = 0;  ///< 0: any
  double sharp = 0;  ///< where the way of the points turns by more than this are corners, in radians; 0: none are
  double tolerance = 1e-5;                                          ///< how near to the fairest, a share of the size
  int most_steps = 120;                                             ///< of all programs
  std::size_t most_work = std::numeric_limits<std::size_t>::max();  ///< then it ends with what it has
};

/// How far the points of a task are from a robust curve through them, by the order of the task's own nodes and then of
/// the scattered ones, with their numbers; in standard deviations of what the nearer half of them is away.
std::vector<std::pair<Index, double>> robust_deviations(const CurveFitTask& task);

/// The root mean square distance of the points from a curve that noise of the task's standard deviation leaves.
double rms_of_noise(const CurveFitTask& task);

/// The smooth curve near the points that steps begin with, where a tolerance is given.
CurveFound start_of(const CurveFitTask& task);

/// The fairest curve through a task's held nodes that its points allow: of least change of curvature within a tolerance
/// or a root mean square, or where springs and points balance. Each step is a convex program about the curve as it is.
CurveFound fit_curve(const CurveFitTask& task, const std::function<void(double share)>& progress);

}  // namespace vspring
