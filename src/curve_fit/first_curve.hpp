#pragma once

#include "curve_fit/curve_fitter.hpp"

namespace vspring {

/// Of all edges.
double length_of(const DenseCurve& curve);

/// Between nodes: in less than that a curve does not get from one bound to the other and back.
double least_spacing(const CurveFitTask& task);

/// How far points may be from the curve.
void set_bounds(const CurveFitTask& task, CurveFound& found);

/// Nodes go across the curve, so free ends go to where the points and the way end: what is beyond is cut off, what is
/// missing is added straight on.
void fit_ends(CurveFound& found);

/// Places of points, and of the way, are carried over.
void take_new_nodes(CurveFound& found, DenseCurve now);

}  // namespace vspring
