#pragma once

#include "fit/tolerance_fit.hpp"

namespace vspring {

/// The shape of least bending whose points all lie within the tolerance, from one whose points about do: by a
/// primal-dual interior-point method (S. J. Wright, "Primal-Dual Interior-Point Methods", SIAM 1997), each of whose
/// steps is an equilibrium. A point pulls by how steep the barrier of its two bounds is, to where the barrier's slope
/// asks; as the barrier falls, points inside come to pull at nothing and those at the bound by just enough. As bending
/// falls, curvature comes to change at once where single points hold: the way ends where energy has risen by a tenth.
/// Leaves the shape in the net.
ToleranceFitResult hold_between(const ToleranceFitTask& task, double tolerance, ToleranceFitResult smooth);

}  // namespace vspring
