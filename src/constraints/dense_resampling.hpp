#pragma once

#include "vspring/resample.hpp"

namespace vspring {

/// New nodes as resample() shares them out on `curve`, but along `smooth`, which has the same chains and constraints,
/// and every edge cut into `times`: along each chain every so manieth node, from the first on, is one that resample()
/// has. Throws as it does.
Resampled resample_densely(const PolygonCurve& curve, const PolygonCurve& smooth, const Constraints& constraints,
                           const Resampling& how, Index times);

}  // namespace vspring
