#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// fit() with options.fair.sharp_edges: the chains first, then the sides. Throws Error(invalid_argument) for voxels.
FitResult fit_sharp_sides(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                          FitOptions options, Context& context);

}  // namespace vspring
