#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/fair.hpp"
#include "vspring/fit.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// A plane of symmetry, through a point, in units of the shape.
struct MirrorPlane {
  Vector3 point = Vector3::Zero();    ///< in the plane
  Vector3 normal = Vector3::UnitX();  ///< of unit length
  /// What messages call it after "the plane", such as "x = 0"; may be empty.
  std::string name = {};

  /// How far a place lies from the plane, on the side of the normal; negative on the other side.
  [[nodiscard]] double distance(const Vector3& place) const { return (place - point).dot(normal); }
  /// The mirror image of a place. For the planes x = 0, y = 0 and z = 0 only the sign of one coordinate changes.
  [[nodiscard]] Vector3 mirrored(const Vector3& place) const { return place - 2 * distance(place) * normal; }
  /// The mirror image of a direction.
  [[nodiscard]] Vector3 mirrored_direction(const Vector3& direction) const {
    return direction - 2 * direction.dot(normal) * normal;
  }
  /// The nearest place in the plane.
  [[nodiscard]] Vector3 projected(const Vector3& place) const { return place - distance(place) * normal; }
};

/// Parses a plane: `x`, `y` or `z` (the plane where that coordinate is 0), `x=2.5`, or `plane:px,py,pz,nx,ny,nz`, by a
/// point and a normal of any length. Throws Error(unusable_constraint) for anything
/// else. Cost: constant.
[[nodiscard]] MirrorPlane parse_plane(std::string_view specification);

/// A shape that is symmetric about a plane: its whole, and which nodes are mirror images of each other.
template <typename Shape>
struct Symmetric {
  MirrorPlane plane;  ///< of symmetry
  /// The shape as given: one half, or the whole.
  Shape given;
  bool is_half = false;  ///< whether it was one half
  /// The whole, exactly symmetric. Nodes and faces (chains) of a half come first, with their numbers; then those of its
  /// mirror image follow. A whole has its own nodes, each pair at the mean of the one and the mirror image of the
  /// other. Nodes on the plane are exactly in it.
  Shape whole;
  /// Per node of `whole` its mirror image; nodes on the plane have themselves, nodes of no face (edge) −1.
  std::vector<Index> partner;
  Index pairs = 0;     ///< pairs of nodes of the whole
  Index on_plane = 0;  ///< nodes on the plane
};

/// Finds how a surface is symmetric about a plane. If it lies on one side it is a half, which is joined with its mirror
/// image along its boundary edges in the plane: those whose ends are no further from the plane than 1e-6 of the
/// diagonal of the box around the faces. If it reaches about as far on both sides it is a whole: every node must have a
/// mirror image, another node or itself, no further from the exact place than half the mean length of its
/// edges, and every face must have one. Nodes of no face do not count.
///
/// Throws Error(unusable_shape), naming the node or face, if the plane misses the shape; for a node of a half beyond
/// the plane; for a node of a half on the plane to which no boundary edge in the plane leads, and for an edge in the
/// plane inside a half or a face in it; for a node or face of a whole without a mirror image; for a coordinate that is
/// not finite. Throws Error(invalid_argument) for a normal that is not of unit length. Cost: n log n.
[[nodiscard]] Symmetric<PolygonMesh> find_symmetry(const PolygonMesh& mesh, const MirrorPlane& plane);

/// Finds how a curve is symmetric about a plane. A half is joined with its mirror image at the ends of chains that lie
/// in the plane: a chain with one end there becomes a longer one, a chain with both a closed one. Throws and costs what
/// find_symmetry() of a mesh does; a half may have only ends of open chains on the plane.
[[nodiscard]] Symmetric<PolygonCurve> find_symmetry(const PolygonCurve& curve, const MirrorPlane& plane);

/// Makes constraints of the whole symmetric. The image of a half is held as the half is. In a whole the constraints of
/// both nodes of a pair must agree: positions as closely as the nodes themselves or 1e-6 of the diagonal, directions to
/// 0.01 radians; both then get the mean. On the plane positions, normals and tangents are made exact: a normal lies in
/// the plane, a tangent across it.
///
/// constraints: of the nodes of the whole, or of those of the given shape. Returns those of the whole. Throws
/// Error(unusable_constraint) naming the nodes where they do not agree, and Error(invalid_argument) for another number
/// of nodes. Cost: linear.
[[nodiscard]] Constraints symmetric_constraints(const Symmetric<PolygonMesh>& shape, const Constraints& constraints);
[[nodiscard]] Constraints symmetric_constraints(const Symmetric<PolygonCurve>& shape, const Constraints& constraints);

/// Fairs a symmetric surface or curve: a half as the whole would be, so that nodes on the plane slide in it and the
/// shape meets its mirror image smoothly; a whole so that it comes out symmetric. The whole is faired as by fair();
/// then both nodes of each pair go to the mean of the one and the mirror image of the other, and nodes on the plane
/// into it. For the planes x = 0, y = 0 and z = 0 the result is symmetric to the bit.
///
/// constraints: as for symmetric_constraints(). fix_boundary_positions(), fix_boundary_normals(), restrict_to_region()
/// and apply_rules() (see RuleInput::named_nodes) make them for `shape.whole`, where nodes of a half on the plane are
/// no boundary. In FairOptions::corners and sharp_edges the nodes of the given shape are enough.
///
/// Returns positions of the nodes of the given shape; held nodes bit for bit, in a whole at the mean of their pair. The
/// report is of the given shape, too, except work, levels and history, which are of the whole. Texts of warnings name
/// the nodes, faces and points that were given; if they count, and the shape is a half, they say that they count the
/// whole. A half of which free nodes end beyond the plane goes through its mirror image: it is worse than the input
/// (Outcome::worse_than_input), and a warning says so, unless FairOptions::accept_worse is set or a held node is there,
/// too.
///
/// Throws what symmetric_constraints() and fair() throw. Cost: that of fair() for the whole.
[[nodiscard]] FairResult fair(const Symmetric<PolygonMesh>& shape, const Constraints& constraints,
                              const FairOptions& options, Context& context);
[[nodiscard]] FairResult fair(const Symmetric<PolygonCurve>& shape, const Constraints& constraints,
                              const FairOptions& options, Context& context);
template <typename Shape>
[[nodiscard]] FairResult fair(const Symmetric<Shape>& shape, const Constraints& constraints,
                              const FairOptions& options = {}) {
  Context context;
  return fair(shape, constraints, options, context);
}

/// Fits a symmetric surface or curve to points, and makes it symmetric as fair() of a symmetric shape does. Points pull
/// together with their mirror images, so they may lie on either side of the plane, of a half as of a whole. Points
/// nearer to the plane than 1e-6 of the diagonal count once.
///
/// If the points are the own nodes of the given shape, those of the whole pull: those of a half together with their
/// mirror images; in a whole the mean of each pair, with tolerances and noise that allow for how far the nodes are from
/// that. A surface that is a whole is drawn to a tolerance from its nodes and their mirror images.
///
/// For a tolerance, where the mean of both halves leaves it, one half is taken with its mirror image; if that leaves
/// it, too, the whole is drawn nearer, up to four times in all.
///
/// constraints: as for fair(). Returns positions of the nodes of the given shape and distances of the given points from
/// the whole; the report is of both. The numbers of pulling points, of pulled nodes, and those of BoundaryOfPoints are
/// half of those of the whole, where that is a half's; nodes and points on the plane count as one.
///
/// Throws what symmetric_constraints() and fit() throw, and Error(invalid_argument) for coordinates that are kept
/// (FitOptions::moving_axes), and for a tolerance of which the nodes of a curve, a whole, leave less than a quarter, as
/// they are too far from being symmetric. Cost: that of fit() for the whole and twice the points.
[[nodiscard]] FitResult fit(const Symmetric<PolygonMesh>& shape, const Constraints& constraints,
                            const ScatteredPoints& points, const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const Symmetric<PolygonCurve>& shape, const Constraints& constraints,
                            const ScatteredPoints& points, const FitOptions& options, Context& context);
template <typename Shape>
[[nodiscard]] FitResult fit(const Symmetric<Shape>& shape, const Constraints& constraints,
                            const ScatteredPoints& points, const FitOptions& options = {}) {
  Context context;
  return fit(shape, constraints, points, options, context);
}

}  // namespace vspring
