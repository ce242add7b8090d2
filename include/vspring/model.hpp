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

/// Where the regularisation (§4.4) moves a node along the shape. A node's share of a neighbour is the weight of that
/// neighbour in the mean that the node goes to. See docs/distribution.md.
enum class Distribution {
  /// To the mean of its neighbours, as in the paper.
  even,
  /// To the mean with the shares that the input has once noise is taken out of its spacing: long cells and gradings
  /// stay, roughness within some three edges goes.
  smooth,
  /// To the mean with the shares that the input has. Where points draw a surface, its nodes are also drawn back, across
  /// the normal, to their places in the input, as strongly as by all neighbours together. Where they draw a curve, its
  /// nodes are drawn back along the tangent to their places, and by nothing else.
  keep
};

/// What the springs of neighbouring nodes of a surface agree in. See docs/springs.md.
enum class Springs {
  edge,   ///< the difference of their lengths along every edge (Eq. 4), so the shape depends on how edges run
  sphere  ///< the radii of their mean-curvature spheres: the same shape on every mesh
};

/// What the equilibrium of sphere springs makes even or least. See docs/springs.md.
enum class FairBy {
  curvature,  ///< mean curvature changes as evenly as it can: ΔH = 0
  bending     ///< bending energy ∫ κ1² + κ2² dA is least among shapes nearby: ΔH + 2H(H² − K) = 0
};

/// How closely forces keep to the paper's equations. The equilibrium is where they vanish, in either way.
enum class Forces {
  steady,  ///< without jumps, and stable for every weight of points
  /// As printed. A neighbour's normal turns round at once at a right angle (Eq. 4). Points move their node by the full
  /// distance times k (Eq. 9), so weights of 1 and more may oscillate. Where curves have CurveRules::paper(): nodes of
  /// a planar one have the mean of the normals of their two edges (§4.2); of one in space, those in line with both
  /// neighbours have no normal, so springs and points leave them where they are (§4.8); and the regularisation is what
  /// the way to the mean of the neighbours has across the normal, along the binormal too (§4.4).
  printed
};

/// In which order an iteration of multigrid or sweep moves the nodes, each from the newest places of the others.
enum class SweepOrder {
  parallel,  ///< blocks of near nodes side by side, on any number of threads
  file       ///< as they are numbered, i = 1 … n, as the paper prints it (Fig. 3): on one thread
};

/// The tangent of a curve at a node (§4.8).
enum class CurveTangents {
  circle,  ///< of the circle through the node and its neighbours: exact on circles however uneven the spacing
  chord    ///< along the chord of the neighbours, as in the paper: exact where spacing is even
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
  CurveTangents tangents = CurveTangents::circle;
  CurveWeights weights = CurveWeights::inverse_cube;
  NormalPlane normal_plane = NormalPlane::full;

  /// The paper's own choices.
  [[nodiscard]] static constexpr CurveRules paper() {
    return {CurveTangents::chord, CurveWeights::inverse, NormalPlane::principal};
  }
};

}  // namespace vspring
