#pragma once

#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// How a surface bends at a node. Curvatures are positive where the surface bends away from its normal, as on a sphere
/// with outward normals.
struct NodeCurvature {
  Vector3 normal = Vector3::Zero();      ///< unit length, in the sense of the faces
  double k1 = 0;                         ///< the greater principal curvature, 1/length
  double k2 = 0;                         ///< the smaller one
  Vector3 direction1 = Vector3::Zero();  ///< along which the normal curvature is k1; unit length, of either sense
  Vector3 direction2 = Vector3::Zero();  ///< along which it is k2, at a right angle to direction1
  double k1_along_1 = 0;                 ///< derivative of k1 along direction1, 1/length²
  double k1_along_2 = 0;                 ///< of k1 along direction2
  double k2_along_1 = 0;                 ///< of k2 along direction1
  double k2_along_2 = 0;                 ///< of k2 along direction2
  /// Degree of the polynomial that the nodes around determine, 0 to 4. Below 3 the derivatives of curvature are zero.
  /// Below 2 the curvatures and their directions are zero too. At 0 the normal is zero or a rough estimate.
  int degree = 0;

  /// The mean curvature, 1/length.
  [[nodiscard]] double mean() const noexcept { return (k1 + k2) / 2; }
  /// The Gaussian curvature, 1/length².
  [[nodiscard]] double gaussian() const noexcept { return k1 * k2; }
};

/// Returns the curvatures of a surface, one entry per node. Each comes from a polynomial of fourth degree through the
/// node, fitted by least squares to the nodes of two to five rings of faces around (osculating jets: Cazals and Pouget
/// 2005). On smooth surfaces of any meshing, also at boundaries, the error of curvatures is of third order in the
/// spacing, that of their derivatives of second. Never NaN: see NodeCurvature::degree. The same bits for every number
/// of threads. Cost: linear, some microseconds per node. When cancelled, nodes not yet looked at have degree 0.
[[nodiscard]] std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh, const Context& context);
[[nodiscard]] std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh);

/// Returns the curvature of a curve, one entry per node, 1/length, never negative: that of the circle through the node
/// and its two neighbours. Zero at open ends and where there is no circle. Where several chains run through a node, the
/// last one counts. On smooth curves of even spacing the error is of second order in the spacing. Cost: linear.
[[nodiscard]] std::vector<double> curvatures(const PolygonCurve& curve);

}  // namespace vspring
