#pragma once

#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Bending of a run of a curve.
struct CurveBending {
  double length = 0;
  double squares = 0;                    ///< ∫ κ² ds
  double rates = 0;                      ///< ∫ |dκ/ds|² ds, in a rotation-minimising frame
  std::vector<double> signed_curvature;  ///< at the inner nodes, all nodes of a closed run; changes sign at inflections
};

/// Measures the polygon through `positions`, of which no two in succession may be equal. The circle through three nodes
/// has the curve's curvature at the mean of their arc lengths, to second order for any spacing. The difference of two
/// such curvatures over the distance of their places is the derivative at the mean of the four nodes. So both integrals
/// are of second order. The outermost values extend to the ends.
///
/// A curvature vector is compared with the next one after the rotation of least angle that takes the one tangent to the
/// other (a rotation-minimising frame: W. Wang et al., "Computation of rotation minimizing frames", ACM Trans. Graph.
/// 27, 2008). `straight`: curvature up to this is taken for rounding and has no side.
CurveBending curve_bending(const std::vector<Vector3>& positions, bool closed, double straight);

}  // namespace vspring
