#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// What changes in the report where nodes have moved once more, in a fit of a surface to its own nodes.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const FitOptions& options, FitResult& found,
                   int threads);

/// The same where a fit to scattered points held a boundary that it had found before: how far points were from the
/// mesh, and are at the end. Those beside the boundary count then, as the constraints do not hold it; some may be
/// beyond the tolerance.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                   const FitOptions& options, FitResult& found, int threads);

}  // namespace vspring
