#include "symmetry/half.hpp"
#include "symmetry/pairs.hpp"
#include "symmetry/reach.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

namespace {

template <typename Shape>
Symmetric<Shape> symmetry_of(const Shape& shape, const MirrorPlane& plane) {
  const Reach reach(shape, plane);
  return reach.is_half(plane) ? symmetric_of_half(shape, plane, reach) : symmetric_of_whole(shape, plane, reach);
}

}  // namespace

Symmetric<PolygonMesh> find_symmetry(const PolygonMesh& mesh, const MirrorPlane& plane) {
  return symmetry_of(mesh, plane);
}

Symmetric<PolygonCurve> find_symmetry(const PolygonCurve& curve, const MirrorPlane& plane) {
  return symmetry_of(curve, plane);
}

}  // namespace vspring
