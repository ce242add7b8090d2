#pragma once

#include "vspring/fair.hpp"

namespace vspring {

/// Boundary first, then the surface (§4.5): fair() with options.fair_boundary.
FairResult fair_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, FairOptions options,
                               Context& context);

}  // namespace vspring
