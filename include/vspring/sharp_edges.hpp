#pragma once

#include <string>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

class Constraints;

/// Sharp edges of a surface, such as chines, knuckles and the edges of a machined part. Each side meets them with its
/// own tangent plane.
struct SharpEdges {
  MeshEdges edges;  ///< ascending, the smaller node first
  /// Their chains, with all nodes of the mesh, or with none where no edge is sharp: open ones between corners, ends and
  /// places where a crease runs out, or closed ones.
  PolygonCurve chains;
  std::vector<Index> corners;  ///< nodes at which three sharp edges or more meet; ascending
};

/// Finds the sharp edges of a mesh: edges of two faces whose normals differ by more than `angle`. angle: degrees, more
/// than 0 and less than 180. Edges of a face without area are not sharp. Throws Error(invalid_argument) for an angle
/// out of range, and Error(unusable_shape) naming a node of a face that is not finite. Cost: n log n.
[[nodiscard]] SharpEdges find_sharp_edges(const PolygonMesh& mesh, double angle);

/// Finds them in a mesh with noise, as NoiseEstimate::deviation tells it: edges of the surface without that noise, as
/// Noise leaves it, that turn by more than `angle`. From their ends chains go on along edges that turn by more than
/// half of it. Chains of one or two edges that end inside the surface are left out, and so are edges around fewer than
/// six faces. noise: in units of the mesh; 0: as above. Throws what find_sharp_edges() without noise and fit() throw.
/// When cancelled, returns the edges of the mesh with its noise. Cost: that of a fit by Noise.
[[nodiscard]] SharpEdges find_sharp_edges(const PolygonMesh& mesh, double angle, double noise, Context& context);

/// The chains and corners of sharp edges that are given. Throws Error(unusable_constraint) naming an edge that the mesh
/// does not have, or of other than two faces. Cost: n log n.
[[nodiscard]] SharpEdges as_sharp_edges(const PolygonMesh& mesh, const MeshEdges& edges);

/// An edge that cannot be sharp.
struct LeftOutEdge {
  Index first;      ///< one of its nodes, as given
  Index second;     ///< the other one
  std::string why;  ///< for people: what is at fault
};

/// The same, of marks in a file for instance: edges that cannot be sharp are left out, and appended to `left_out` in
/// the order given. Cost: n log n.
[[nodiscard]] SharpEdges as_sharp_edges(const PolygonMesh& mesh, const MeshEdges& edges,
                                        std::vector<LeftOutEdge>& left_out);

/// As fix_boundary_normals() of constraints.hpp, by the faces of each node's own side of sharp edges; nodes of these
/// get none where sides part. sharp: as for as_sharp_edges(), and throws what that throws. Cost: n log n; linear where
/// there are none.
void fix_boundary_normals(Constraints& constraints, const PolygonMesh& mesh, const MeshEdges& sharp);

/// The lengths of the chains of a curve, in their order. Cost: linear.
[[nodiscard]] std::vector<double> chain_lengths(const PolygonCurve& curve);

}  // namespace vspring
