#pragma once

#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// The main figures of how fair a shape is, all independent of scale. Definitions: docs/fairness.md.
struct Fairness {
  /// Σ over edges ((t_j − t_i)/ℓ)²: how much neighbouring springs differ (Eq. 4), relative to the edge length ℓ.
  double vspring_energy = 0;
  /// Largest angle between the normals of two faces that share an edge, or between successive edges of a curve,
  /// degrees.
  double greatest_turn = 0;
  /// Root mean square of that angle over all edges between two faces, or over all inner nodes, degrees.
  double rms_turn = 0;
};

/// Measures a surface. Pseudo-normals are those of PseudoNormals::link, or the given ones. Faces without area and edges
/// without two faces are left out. With constraints, only edges with a moving node count. The same bits on any number
/// of threads; without a context, one thread. Cost: linear.
[[nodiscard]] Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, const Context& context);
[[nodiscard]] Fairness measure(const PolygonMesh& mesh, const Constraints* constraints = nullptr);

/// Measures a curve. Tangents are those of the circles through successive nodes, or the given ones. With constraints,
/// only moving nodes and held nodes beside them count. Cost: linear.
[[nodiscard]] Fairness measure(const PolygonCurve& curve, const Constraints* constraints = nullptr);

}  // namespace vspring
