#pragma once

#include <optional>
#include <span>

#include "vspring/types.hpp"

namespace vspring {

/// How a curve leaves one of its nodes.
struct CurveSide {
  Vector3 tangent = Vector3::Zero();    ///< of unit length, away from the node
  Vector3 curvature = Vector3::Zero();  ///< the vector across it
  double variance = 0;                  ///< of the curvature, by what the places are off and how many there are
};

/// How a curve leaves the first of these places, by the arc nearest to them whose curvature is constant, linear or
/// quadratic in arc length: of this and of the first 11, 21, 41 and more places, by what tells the curvature best. What
/// places are off an arc of one term more is noise, and what they are off others more than that is the error of these
/// (as Mallows' C_p has it: C. L. Mallows, "Some Comments on C_p", Technometrics 15, 1973). Exact on circles and, from
/// eight places on, on Euler spirals. None where there are less than three places, or they are off by more than noise.
///
/// places: in order, of any spacing. Cost: linear in the places taken.
std::optional<CurveSide> curve_side(std::span<const Vector3> places);

/// The curvature at the first of three places or more without noise, by the arc of cubic curvature through as many of
/// them as one is found for. Cost: linear.
std::optional<Vector3> curvature_at_first(std::span<const Vector3> places);

}  // namespace vspring
