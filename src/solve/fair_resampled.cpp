#include "vspring/fair_resampled.hpp"

#include <algorithm>
#include <cstddef>

namespace vspring {

ResampledFair fair_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                             const FairOptions& options, Context& context) {
  ResampledFair result{resample(curve, constraints, how), {}};
  const Resampled& resampled = result.resampled;
  FairOptions own = options;
  own.corners.clear();
  for (std::size_t k = 0; k < resampled.from.size(); ++k) {
    if (std::find(how.corners.begin(), how.corners.end(), resampled.from[k]) != how.corners.end())
      own.corners.push_back(static_cast<Index>(k));
  }
  result.fair = fair(resampled.curve, resampled.constraints, own, context);
  return result;
}

}  // namespace vspring
