#pragma once

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Takes a surface that fair() has made with tangent planes on to Continuity::curvature. Where that is not possible, or
/// its faces would fold or cross, it stays, and a warning says why. constraints: that fair() had. strength: of that,
/// and now of this.
void join_with_curvature(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                         double strength, Context& context, FairResult& result);

}  // namespace vspring
