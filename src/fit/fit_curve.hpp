#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// fit() of a curve by EquilibriumMethod.
FitResult fit_curve(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context);

/// fit_resampled() by that.
ResampledFit fit_curve_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                                 const FitOptions& options, Context& context);

}  // namespace vspring
