#pragma once

#include "fit/tolerance_fit.hpp"

namespace vspring {

/// The shape of least bending whose points all lie within the tolerance, from one whose points about do: by a
/// primal-dual interior-point method (S. J. Wright, "Primal-Dual Interior-Point Methods", SIAM 1997), each of whose
/// steps is an equilibrium. A point pulls as strongly as the barrier of its two bounds is curved there, towards where
/// its slope leads; as the barrier falls, points inside cease to pull, and those at a bound pull just enough. As
/// bending falls, curvature begins to jump where single points hold the shape: the search ends where the energy has
/// risen by a tenth. Leaves the shape in the net.
ToleranceFitResult hold_between(const ToleranceFitTask& task, double tolerance, ToleranceFitResult smooth);

}  // namespace vspring
