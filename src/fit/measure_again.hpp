#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// Updates the report after nodes have moved once more, in a fit of a surface to its own nodes.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const FitOptions& options, FitResult& found,
                   int threads);

/// The same in a fit to scattered points: how far they were from the mesh, and are at the end. Some may be beyond the
/// tolerance, beside lines of the surface that were fitted first.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                   const FitOptions& options, FitResult& found, int threads);

/// The same where such a fit held a boundary that it had drawn to where the points end. start, held: the surface with
/// that boundary, and its constraints. Points nearest to it do not count, as with other held nodes: where points end
/// unevenly, some lie beyond a fair boundary.
void measure_again_at_boundary(const PolygonMesh& mesh, const Constraints& constraints, const PolygonMesh& start,
                               const Constraints& held, const ScatteredPoints& points, const FitOptions& options,
                               FitResult& found, int threads);

}  // namespace vspring
