#pragma once

#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// The shortest account of how fair a shape is. All figures are free of scale. Definitions of these and others:
/// docs/fairness.md.
struct Fairness {
  /// Σ over edges ((t_j − t_i)/ℓ)²: the springs' disagreement (Eq. 4) relative to the edge length ℓ.
  double vspring_energy = 0;
  /// Largest angle between the normals of two faces that share an edge, or between successive edges of a curve,
  /// degrees.
  double greatest_turn = 0;
  /// Root mean square of that angle over all edges between two faces, or over all inner nodes, degrees.
  double rms_turn = 0;
};

/// Measures a surface. Pseudo-normals are Max's around the link, or the given ones where a constraint fixes them. Faces
/// without area and edges without two faces are left out. With constraints only what lies at moving nodes is measured.
/// The same bits on any number of threads; one where no context is given. Cost: linear.
[[nodiscard]] Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, const Context& context);
[[nodiscard]] Fairness measure(const PolygonMesh& mesh, const Constraints* constraints = nullptr);

/// Measures a curve, with the tangents of the circles through successive nodes, or the given ones where a constraint
/// fixes them. With constraints only what moving nodes have a part in is measured: at them and at held nodes beside
/// them. Cost: linear.
[[nodiscard]] Fairness measure(const PolygonCurve& curve, const Constraints* constraints = nullptr);

}  // namespace vspring
