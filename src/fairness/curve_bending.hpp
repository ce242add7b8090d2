#pragma once

#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// How a run of a curve bends.
struct CurveBending {
  double length = 0;
  double squares = 0;                    ///< ∫ κ² ds
  double rates = 0;                      ///< ∫ |dκ/ds|² ds, along the curve without turning about it
  std::vector<double> signed_curvature;  ///< at the inner nodes, all nodes of a closed run; changes sign at inflections
};

/// Of the polygon through `positions`, no two in succession equal. The curvature of the circle through three nodes is
/// that of the curve at the mean of their arc lengths, to second order whatever the spacing, and differences of two of
/// them over the distance of these places are the derivative at the mean of all four nodes; so both integrals are of
/// second order. Up to the ends the nearest value goes on.
///
/// A curvature vector is compared with the next one after the rotation of least angle that takes the one tangent to the
/// other (a rotation-minimising frame: W. Wang et al., "Computation of rotation minimizing frames", ACM Trans. Graph.
/// 27, 2008). `straight`: curvature up to this is taken for rounding and has no side.
CurveBending curve_bending(const std::vector<Vector3>& positions, bool closed, double straight);

}  // namespace vspring
