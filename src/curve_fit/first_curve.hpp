#pragma once

#include "curve_fit/curve_fitter.hpp"

namespace vspring {

/// The least spacing of nodes: within less a curve does not get from one bound to the other and back.
double least_spacing(const CurveFitTask& task);

/// Sets how far points may be from the curve.
void set_bounds(const CurveFitTask& task, CurveFound& found);

/// Moves free ends to where the points and the way end, as steps move nodes only across the curve: cuts the curve off
/// there, or extends it by a straight line.
void fit_ends(CurveFound& found);

/// Replaces the curve by one with new nodes, and carries the places of points and of the way over.
void take_new_nodes(CurveFound& found, DenseCurve now);

}  // namespace vspring
