#pragma once

#include <vector>

#include "fit/curve_measures.hpp"
#include "vspring/context.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// A curve that was found, and the nodes that were put on it.
struct FittedCurve {
  CurveFound found;
  Resampled nodes{.curve = {}, .constraints = Constraints(0), .from = {}};
  // Of the nodes, as of MeasuredNodes.
  double way_beyond = 0;
  Index new_folds = 0;
  double leeway = 1;  ///< how far points may be: in the tolerance, which is inexact where noise has chosen it
};

/// positions: of `nodes`, which are the file's or new ones.
FitResult result_of(const CurveFitInput& input, const CurveMeasures& measures, const FittedCurve& curve,
                    std::vector<Vector3> positions, const Resampled& nodes, const Context& context);

}  // namespace vspring
