#pragma once

#include "vspring/export.hpp"
#include "vspring/fair.hpp"
#include "vspring/resample.hpp"

namespace VSPRING_API vspring {

/// A curve with new nodes, and its fair shape.
struct ResampledFair {
  Resampled resampled;  ///< as resample() gives it
  FairResult fair;      ///< positions of the nodes of resampled.curve
};

/// Puts new nodes along a curve as resample() does, and fairs the new curve. Corners of `how` are corners of the new
/// curve, too; options.corners is ignored. Throws and costs what resample() and fair() do.
[[nodiscard]] ResampledFair fair_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                           const Resampling& how, const FairOptions& options, Context& context);

}  // namespace vspring
