#include "fit/fit_curve.hpp"
#include "fit/fit_points.hpp"
#include "vspring/fit.hpp"

namespace vspring {

ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                           const FitOptions& options, Context& context) {
  options.validate();
  const bool has_nodes_of_its_own = !options.weight() || options.least_radius > 0 || has_corners(options, constraints);
  if (options.fair.method_kind() == Method::equilibrium && has_nodes_of_its_own)
    return fit_curve_resampled(curve, constraints, how, options, context);
  ResampledFit made{resample(curve, constraints, how), {}};
  made.fit = fit(made.resampled.curve, made.resampled.constraints, {.positions = curve.positions()}, options, context);
  return made;
}

ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                           const FitOptions& options) {
  Context context;
  return fit_resampled(curve, constraints, how, options, context);
}

}  // namespace vspring
