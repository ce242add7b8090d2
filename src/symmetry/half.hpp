#pragma once

#include "symmetry/reach.hpp"

namespace vspring {

/// Joins halves with their mirror images. Throw Error(unusable_shape) as find_symmetry() does.
Symmetric<PolygonMesh> symmetric_of_half(const PolygonMesh& mesh, const MirrorPlane& plane, const Reach& reach);
Symmetric<PolygonCurve> symmetric_of_half(const PolygonCurve& curve, const MirrorPlane& plane, const Reach& reach);

}  // namespace vspring
