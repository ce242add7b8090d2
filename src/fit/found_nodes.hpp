#pragma once

#include "curve_fit/curve_fitter.hpp"
#include "fit/curve_fit_input.hpp"
#include "vspring/resample.hpp"

namespace vspring {

/// The file's nodes on the curve that was found: at the nearest places if they are the points, at their stations if
/// these stay, else by the spacing.
Resampled own_nodes(const CurveFitInput& input, const CurveFound& found, Distribution spacing);

/// New nodes on it, spaced as they are to be.
Resampled new_nodes(const CurveFitInput& input, const CurveFound& found, const Resampling& how);

}  // namespace vspring
