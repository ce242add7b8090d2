#pragma once

#include "vspring/fit.hpp"

namespace vspring {

/// What changes in the report where nodes have moved once more, in a fit of a surface to its own nodes.
void measure_again(const PolygonMesh& mesh, const Constraints& constraints, FitResult& found, int threads);

}  // namespace vspring
