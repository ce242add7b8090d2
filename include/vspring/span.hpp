#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/surface_file.hpp"
#include "vspring/symmetry.hpp"

namespace VSPRING_API vspring {

/// A curve of a network, from one junction or corner to the next.
struct NetworkCurve {
  /// Nodes of the input along it. A closed curve that meets no other repeats its first node at the end. Where curves
  /// cross between nodes there is none of the input: −1.
  std::vector<Index> from;
  /// Nodes of SpannedCurves::mesh along it, with its first node at the end if it is closed; empty if no surface meets
  /// it.
  std::vector<Index> nodes;
  double length = 0;      ///< in units of the input
  bool is_sharp = false;  ///< whether it is part of a sharp chain
  int loops = 0;          ///< how many spanned loops run along it; twice along a seam
};

/// What became of a loop.
enum class LoopState : std::uint8_t {
  spanned,  ///< by faces of SpannedCurves::mesh
  /// left open, as the outer rim of a sheet: NetworkLoop::is_outer(), and a lid or not to be spanned by any faces
  outer,
  /// left open: a lid, as over the end of a tube. It turns by more than 60° from the loops beside it, and has no corner
  /// or turns nearly all around from loops most of which do not. One whose curves are sharp is spanned
  lid,
  left_out,     ///< left open: not among SpanOptions::loops, or among SpanOptions::without
  unspannable,  ///< left open: a warning says why
  cancelled     ///< left open: the call was cancelled before
};

/// "spanned", "outer", "lid", "left-out", "unspannable" or "cancelled".
[[nodiscard]] const char* name(LoopState state) noexcept;

/// A closed loop of curves.
struct NetworkLoop {
  std::vector<Index> curves;     ///< numbers of its curves, in order
  std::vector<Index> junctions;  ///< nodes of the input where each curve begins, −1 as in NetworkCurve::from
  double length = 0;             ///< in units of the input
  /// The mean cosine of the angle between its normal and those of the loops beside it, each reversed, weighted by the
  /// lengths of the curves between: 1 at the outer rim of a flat sheet, 0 at the end of a tube, near −1 inside a
  /// surface.
  double facing = -1;
  /// For a spanned loop and a lid: the mean angle before fairing between its faces and those of spanned loops beside
  /// it across curves that are not sharp, in degrees; 0 if there are none.
  double turn = 0;
  LoopState state = LoopState::spanned;  ///< what became of it
  bool is_grid = false;                  ///< whether its faces are a grid of quads; else they are triangles
  // For a spanned loop: its faces and the nodes within it, which are consecutive.
  Index first_node = -1;  ///< −1 for a loop that is not spanned
  Index node_count = 0;   ///< nodes within it
  Index first_face = -1;  ///< −1 for a loop that is not spanned
  Index face_count = 0;   ///< its faces

  /// Whether `facing` is more than 0.5.
  [[nodiscard]] bool is_outer() const noexcept { return facing > 0.5; }
};

/// How curves are spanned.
struct SpanOptions {
  /// Length of edges, in units of the input, more than 0. Empty: an 80th of the diagonal of the box around the curves.
  std::optional<double> edge_length = std::nullopt;
  /// Curves that come nearer to each other than this meet there; in units of the input, 0 or more. Empty: 1e-3 of the
  /// diagonal of that box.
  std::optional<double> join = std::nullopt;
  /// Span only these loops, by their numbers in SpannedCurves::loops. Empty: all but outer rims and lids.
  std::vector<Index> loops = {};
  /// Span these, too: outer rims and lids.
  std::vector<Index> also = {};
  /// Leave these loops open.
  std::vector<Index> without = {};
  /// Numbers of the chains of the input that are sharp: the surfaces on both sides have tangent planes of their own.
  std::vector<Index> sharp = {};
  /// The curves are faired first, as curves in space through their junctions. Else they stay: new nodes lie on cubics
  /// through the nodes of the input.
  bool fair_curves = false;
  /// Where the surface ends in this plane it is at right angles to it, but not along sharp chains.
  std::optional<MirrorPlane> symmetry = std::nullopt;
  /// Do not fair the surface: grids are Coons's patches, other loops have triangles of least dihedral angles.
  bool flat = false;
  /// How the surface is faired. Options of boundaries, corners, sharp edges and points are ignored.
  FairOptions fair = {};

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;
};

/// A surface through curves.
struct SpannedCurves {
  /// Nodes of the curves first, then those within the loops, loop by loop, as its faces are; where they are before
  /// fairing.
  PolygonMesh mesh;
  /// The same nodes after fairing; those of curves stay.
  std::vector<Vector3> positions;
  std::vector<NetworkCurve> curves;  ///< of the network, whether a surface meets them or not
  std::vector<NetworkLoop> loops;    ///< ordered by their first curves
  /// What held the nodes while the surface was faired: positions on curves, normals where the surface ends. Where sides
  /// of a sharp curve part they have normals of their own, which are not among these.
  Constraints constraints = Constraints(0);
  MeshEdges sharp_edges;      ///< along sharp curves between two faces; ascending, the smaller node first
  Index symmetric_nodes = 0;  ///< nodes where the surface ends in the plane of SpanOptions::symmetry
  /// Of the surface's fairing, and with SpanOptions::fair_curves the worst outcome and the warnings of the curves',
  /// too.
  FairReport report;

  /// Whether report.usable(), and no loop that was to be spanned is left open, as LoopState::unspannable.
  [[nodiscard]] bool usable() const noexcept;
};

/// Spans the loops of a network of curves with fair surfaces (paper §1: boundary curves first, then the surface between
/// them).
///
/// Curves are joined where they meet, also those that are drawn twice, and cut at junctions and corners (turns of more
/// than 65°, or of more than 30° that are twice those at the nodes beside). A curve that ends freely bounds nothing. At
/// every junction curves are put in order around the normal of the plane that they spread in, or on a ridge around the
/// mean of their directions, and normals are carried along curves from one junction to the next, so that each loop is
/// followed with the surface on its left. Outer rims of sheets and lids are left open. Normals of faces point away from
/// the middle of the surface; those of a flat one to the positive side of the coordinate plane from which most of it is
/// seen. A warning says where the surface crosses itself.
///
/// Each curve is divided into edges of about the same length. A loop of four sides of which opposite ones have the same
/// number of edges gets a grid of quads (S. A. Coons, Surfaces for computer-aided design of space forms, 1967); for
/// that, opposite sides get the same number if their lengths differ by less than a factor of 2.5. Others get triangles
/// as fill_holes() makes them.
///
/// The surface is then faired with the nodes of curves held. It is smooth across curves between two loops, by the
/// solution on both sides at once, unless they are sharp. Where it ends, and on each side of a sharp curve, its tangent
/// planes are those of the curve and the ones that cross or meet it, and between these they turn about the curve as a
/// cubic; where none meets it, they are free.
///
/// The result has the same bits for every number of threads. When cancelled, loops without faces yet stay open, and the
/// surface is as far as it has come.
///
/// Throws what SpanOptions::validate() throws; Error(unusable_shape) naming a node that is not finite, and where no
/// curves make a loop; Error(invalid_argument) naming a loop or a chain of the options that there is not, and for an
/// edge length that asks for more than ten million nodes. Cost: n log n in the nodes of the curves; that of
/// fill_holes() for loops of triangles, and that of fair().
[[nodiscard]] SpannedCurves span_curves(const PolygonCurve& curves, const SpanOptions& options, Context& context);
[[nodiscard]] SpannedCurves span_curves(const PolygonCurve& curves, const SpanOptions& options = {});

/// The surface as an OBJ file that is ready to be written, in which the faces of loop 3 are the group "loop_3", and
/// lines along sharp curves mark their edges, as marked_edges() reads them. Cost: linear.
[[nodiscard]] SurfaceFile file_of(const SpannedCurves& spanned);

}  // namespace vspring
