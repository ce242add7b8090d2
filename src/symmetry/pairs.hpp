#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "symmetry/reach.hpp"

namespace vspring {

/// Finds the pairs of wholes. Throw Error(unusable_shape) as find_symmetry() does.
Symmetric<PolygonMesh> symmetric_of_whole(const PolygonMesh& mesh, const MirrorPlane& plane, const Reach& reach);
Symmetric<PolygonCurve> symmetric_of_whole(const PolygonCurve& curve, const MirrorPlane& plane, const Reach& reach);

/// Which half of a whole that is not quite symmetric the other follows.
enum class Leading : std::uint8_t { mean, front, back };

/// Puts each pair at the mean of the one and the mirror image of the other, or one half at the mirror image of the one
/// on the side of the plane's normal (front) or the other, and nodes on the plane into it.
template <typename Shape>
void make_symmetric(const Symmetric<Shape>& shape, std::vector<Vector3>& positions, Leading leading = Leading::mean) {
  for (std::size_t i = 0; i < shape.partner.size(); ++i) {
    const Index partner = shape.partner[i];
    if (partner < static_cast<Index>(i)) continue;
    Vector3& place = positions[i];
    Vector3& other = positions[static_cast<std::size_t>(partner)];
    if (partner == static_cast<Index>(i)) {
      place = shape.plane.projected(place);
      continue;
    }
    const bool is_front = shape.plane.distance(shape.whole.positions()[i]) > 0;
    if (leading == Leading::mean)
      place = (place + shape.plane.mirrored(other)) / 2;
    else if (is_front != (leading == Leading::front))
      place = shape.plane.mirrored(other);
    other = shape.plane.mirrored(place);
  }
}

}  // namespace vspring
