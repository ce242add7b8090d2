#pragma once

#include <optional>
#include <vector>

#include "join/curvature_arc.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A held node through which a curve goes, or at which it ends.
struct CurveJoint {
  Vector3 place = Vector3::Zero();
  std::optional<Vector3> tangent;    ///< along the curve
  std::optional<Vector3> normal;     ///< without a tangent: the curve goes across it
  std::optional<Vector3> curvature;  ///< at an end with a tangent, across that
};

struct CurvatureSpline {
  std::vector<CurvatureArc> arcs;  ///< from each joint to the next; of a closed one also from the last to the first
  int steps = 0;
  double last_step = 0;  ///< the largest change in the last step: of lengths and turns, in lengths of their arcs
};

/// Finds the curve through joints whose curvature is of third degree in arc length between them: one degree more at
/// each end than springs have, with which curvature is linear. So it can have a given curvature at ends.
///
/// Inside, curvature, its derivative and its second derivative are continuous at joints; where a direction is given,
/// the second derivative across it jumps. An end has a place and
/// - a tangent and a curvature,
/// - or a tangent: the third derivative of the curvature is zero there, or the second if the other end has no curvature
///   either,
/// - or neither: the curvature and its second derivative are zero.
///
/// start: arcs near the ones that are sought, one to each stretch. Newton's steps, halved where the curve would come no
/// nearer. None where they lead nowhere. Cost: linear. Throws Cancelled.
std::optional<CurvatureSpline> curvature_spline(const std::vector<CurveJoint>& joints, bool closed,
                                                std::vector<CurvatureArc> start);

}  // namespace vspring
