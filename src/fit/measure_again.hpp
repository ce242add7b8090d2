#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// What changes in the report where nodes have moved once more, in a fit of a surface to its own nodes.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, FitResult& found, int threads);

/// The same where a fit to scattered points began with another boundary than that of the mesh, and then went a share
/// `strength` of the way: how far points were before, and, of a share, are after.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                   double strength, FitResult& found, int threads);

}  // namespace vspring
