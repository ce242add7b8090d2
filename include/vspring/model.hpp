#pragma once

namespace vspring {

/// How the normal of a node follows from the nodes around it (§4.2).
enum class PseudoNormals {
  link,     ///< Max's weights around the link: exact on spheres, isotropic on quads
  average,  ///< plain average of the unit normals of the adjoining faces, as in the paper
  area,     ///< weighted by the areas of the faces
  angle     ///< weighted by the angles of the faces at the node
};

/// Where the tangential regularisation (§4.4) sends a node.
enum class Distribution {
  even,    ///< to the mean of its neighbours, as in the paper
  smooth,  ///< to the share between its neighbours that it has in the input once noise is taken out of its spacing:
           ///< aspects and gradings of cells stay, roughness within some three edges goes
  keep     ///< to the share between its neighbours that it has in the input; where points draw a surface also back,
           ///< across its normal, to where it was, which counts as much as all neighbours do; where they draw a curve
           ///< back along its tangent to where it was, and nothing else
};

/// What the springs of neighbouring nodes of a surface agree in.
enum class Springs {
  edge,   ///< the difference of their lengths along every edge (Eq. 4), which sees which way edges run
  sphere  ///< the radii of their mean-curvature spheres: the same shape on every mesh, see docs/springs.md
};

/// What is least, or even, in the equilibrium of sphere springs.
enum class FairBy {
  curvature,  ///< mean curvature changes as evenly as it can: ΔH = 0
  bending  ///< bending energy ∫ κ1² + κ2² dA, among shapes nearby: ΔH + 2H(H² − K) = 0; see docs/springs.md
};

/// How closely forces keep to the paper's equations. In either way an equilibrium is where they vanish.
enum class Forces {
  steady,  ///< without jumps, and stable however much points weigh
  printed  ///< as printed: a neighbour's normal turns round at once at a right angle (Eq. 4), what points ask for is
           ///< done in full (Eq. 9; weights of 1 and more may oscillate), and a node of a planar curve between two
           ///< neighbours in line with it has no normal and stays (§4.8)
};

/// The tangent of a curve at a node (§4.8).
enum class CurveTangents {
  circle,  ///< of the circle through the node and its neighbours: exact on circles however uneven the spacing
  chord    ///< along the chord of the neighbours, as in the paper: exact where spacing is even
};

/// What the neighbours of a node of a curve count, by the length ℓ of the edge to them.
enum class CurveWeights {
  inverse_cube,  ///< 1/ℓ³: the equilibrium does not depend on the spacing
  inverse        ///< 1/ℓ, as in the paper (Eq. 8)
};

/// Along what the nodes of a space curve are sprung (§4.8).
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
