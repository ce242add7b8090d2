#pragma once

#include "vspring/fair.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// Boundary first, then the surface (§4.5): fair() with options.fair_boundary.
FairResult fair_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, FairOptions options,
                               Context& context);

/// The same of a fit to the surface's own nodes: the boundary is fitted to its nodes as the surface to all, in space
/// with noise as a root mean square. Throws Error(invalid_argument) for other points.
FitResult fit_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                             FitOptions options, Context& context);

}  // namespace vspring
