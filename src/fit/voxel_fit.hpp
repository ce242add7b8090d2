#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// Takes the steps of Voxels off a surface whose own nodes are the points. Throws Error(invalid_argument) for other
/// points, else what fit() does.
FitResult fit_voxels(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                     const FitOptions& options, Context& context);

}  // namespace vspring
