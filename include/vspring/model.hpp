#pragma once

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// How the normal of a node follows from the nodes around it (§4.2).
enum class PseudoNormals {
  link,     ///< Max's weights around the link: exact on spheres, isotropic on quads
  average,  ///< plain average of the unit normals of the adjoining faces, as in the paper
  area,     ///< weighted by the areas of the faces
  angle     ///< weighted by the angles of the faces at the node
};

/// Where the regularisation (§4.4) moves a node along the shape: to a weighted mean of its neighbours, whose weights
/// are their shares. See docs/distribution.md.
enum class Distribution {
  /// Equal shares, as in the paper.
  even,
  /// The shares of the input after noise is removed from its spacing: long cells and gradings stay, roughness within
  /// about three edges goes.
  smooth,
  /// The shares of the input. In fits, the nodes of a surface are also drawn to their places in the input, in the
  /// tangent plane and as strongly as by all neighbours together; those of a curve are drawn to their places along the
  /// tangent, and by nothing else.
  keep
};

/// In what the springs of neighbouring nodes of a surface agree. See docs/springs.md.
enum class Springs {
  edge,   ///< in their lengths along every edge (Eq. 4), so the shape depends on the directions of edges
  sphere  ///< in the radii of their mean-curvature spheres: the same shape on every mesh
};

/// What the equilibrium of sphere springs makes even or least. See docs/springs.md.
enum class FairBy {
  curvature,  ///< mean curvature changes as evenly as it can: ΔH = 0
  bending     ///< bending energy ∫ κ1² + κ2² dA is least among shapes nearby: ΔH + 2H(H² − K) = 0
};

/// How closely forces keep to the paper's equations. Either way they vanish at the equilibrium.
enum class Forces {
  steady,  ///< without jumps, and stable for every weight of points
  /// As printed. A neighbour's normal jumps to its opposite at a right angle (Eq. 4). Points move their node by the
  /// full distance times k (Eq. 9), so weights of 1 and more may oscillate. Curves with CurveRules::paper() differ in
  /// more. Nodes of a planar curve have the mean of the normals of their two edges (§4.2). Nodes of a space curve in
  /// line with both neighbours have no normal, so springs and points do not move them (§4.8). The regularisation acts
  /// across the normal, along the binormal too (§4.4).
  printed
};

/// In which order an iteration of multigrid or sweep moves the nodes. Each node uses the newest positions of the
/// others.
enum class SweepOrder {
  parallel,  ///< blocks of near nodes side by side, on any number of threads
  file       ///< by their numbers, i = 1 … n, as in the paper (Fig. 3); on one thread
};

/// How the tangent of a curve follows from a node and its neighbours (§4.8).
enum class CurveTangents {
  circle,  ///< of the circle through the three nodes: exact on circles, however uneven the spacing
  chord    ///< along the chord of the neighbours, as in the paper: exact for even spacing
};

/// The weights w_j of a curve's neighbours (Eq. 8), by the length ℓ of the edge to them.
enum class CurveWeights {
  inverse_cube,  ///< 1/ℓ³: the equilibrium does not depend on the spacing
  inverse        ///< 1/ℓ, as in the paper (Eq. 8)
};

/// The directions in which the force acts on nodes of a space curve (§4.8).
enum class NormalPlane {
  full,      ///< the whole normal plane, along both N and B
  principal  ///< the principal normal N only: the paper's own variant. Planar curves take their in-plane normal
};

/// The rules of the spring model for curves.
struct CurveRules {
  CurveTangents tangents = CurveTangents::circle;     ///< how tangents follow from the nodes around
  CurveWeights weights = CurveWeights::inverse_cube;  ///< how much each neighbour counts
  NormalPlane normal_plane = NormalPlane::full;       ///< space curves: where the force acts

  /// The paper's own choices.
  [[nodiscard]] static constexpr CurveRules paper() {
    return {CurveTangents::chord, CurveWeights::inverse, NormalPlane::principal};
  }
};

}  // namespace vspring
