#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/surface_file.hpp"

namespace VSPRING_API vspring {

/// What became of a hole.
enum class HoleState : std::uint8_t {
  open,        ///< not considered yet
  filled,      ///< by faces of FilledHoles::mesh
  outer_rim,   ///< left open: the outer rim of a sheet, see Hole::is_outer_rim()
  too_large,   ///< left open: larger than FillOptions allows
  elsewhere,   ///< left open: not at a node of FillOptions::at
  unfillable,  ///< left open: see Hole::fault
  cancelled    ///< left open: the call was cancelled before
};

/// "open", "filled", "outer-rim", "too-large", "elsewhere", "unfillable" or "cancelled".
[[nodiscard]] const char* name(HoleState state) noexcept;

/// Why no faces can fill a hole. Hole::fault_node is the node where.
enum class HoleFault : std::uint8_t {
  none,
  not_finite,        ///< a coordinate of the rim is not finite
  non_manifold,      ///< an edge of more than two faces, or a face that has the node twice, is at the rim
  orientation,       ///< faces along the rim run in different directions
  no_triangulation,  ///< each needs an edge that the mesh has already outside the hole
  folded             ///< each triangulation folds back onto itself or the faces around, or has no area
};

/// A closed loop of boundary edges of a mesh.
struct Hole {
  /// Its nodes, each once, from the smallest number on, in the order in which filling faces run along it.
  std::vector<Index> rim;
  double length = 0;  ///< of the rim, in units of the mesh
  /// The cosine of the angle between the mean normal of the faces at the rim, weighted by area, and the normal of the
  /// rim as a polygon that runs as these faces do: 1 at the rim of a flat sheet, 0 at the end of a tube, near −1 for a
  /// small hole in a smooth surface.
  double facing = 0;
  HoleState state = HoleState::open;  ///< what became of it
  HoleFault fault = HoleFault::none;  ///< why no faces can fill it
  Index fault_node = -1;              ///< where that shows; −1 for HoleFault::none
  // For a filled hole: its new nodes and faces, which are consecutive.
  Index first_node = -1;  ///< −1 for a hole that is not filled
  Index node_count = 0;   ///< new nodes
  Index first_face = -1;  ///< −1 for a hole that is not filled
  Index face_count = 0;   ///< new faces
  /// How the fairing of the patch ended, together with patches that it touches; empty if the patch has no new node, or
  /// fairing was not asked for.
  std::optional<Outcome> outcome = std::nullopt;

  /// Whether `facing` is more than 0.5, as at the rim of a spherical cap of a half angle below 60°.
  [[nodiscard]] bool is_outer_rim() const noexcept;
};

/// One line for people: why a hole cannot be filled, where, and what to do; empty for HoleFault::none.
[[nodiscard]] std::string fault_message(const Hole& hole);

/// Finds the holes of a mesh, ordered by their first nodes. Holes that meet at a node are separate. A hole that
/// certainly cannot be filled has state `unfillable`; so has a chain of boundary edges that ends at an edge of more
/// than two faces. Cost: linear.
[[nodiscard]] std::vector<Hole> find_holes(const PolygonMesh& mesh);

/// Which holes are filled, and how.
struct FillOptions {
  /// Fill only holes through these nodes, also outer rims. Empty: all but outer rims.
  std::vector<Index> at = {};
  /// Fill outer rims as well.
  bool outer_rims = false;
  /// Fill only holes whose rim is at most this long, in units of the mesh; more than 0. Infinite: of any length.
  double most_length = std::numeric_limits<double>::infinity();
  /// Fill only holes whose rim has at most so many edges, 3 or more. The greatest number: any.
  Index most_edges = std::numeric_limits<Index>::max();
  /// Do not fair patches: triangulate and refine them, with creases at the rim.
  bool flat = false;
  /// How patches are faired. Options of boundaries and points are ignored.
  FairOptions fair = {};

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;
};

/// A mesh with its holes filled.
struct FilledHoles {
  /// The mesh, its nodes and faces followed by those of the patches, hole by hole. New nodes lie where the patches are
  /// before fairing.
  PolygonMesh mesh;
  /// The positions of the same nodes after fairing; nodes of the input keep theirs to the bit.
  std::vector<Vector3> positions;
  /// Per new node the nearest rim node along the patch: where colours and the like may be taken from.
  std::vector<Index> node_like;
  /// Per new face the input's face beside the rim there.
  std::vector<Index> face_like;
  std::vector<Hole> holes;  ///< in the order of find_holes()
  /// Of the fairing of all patches: the worst outcome, the sum of the work. Warnings name holes that cannot be filled
  /// and patches that cross other faces.
  FairReport report;

  /// Whether report.usable(), and no hole that was to be filled is left open, as HoleState::unfillable.
  [[nodiscard]] bool usable() const noexcept;

  /// Constraints that hold the nodes of the input and leave the new ones free.
  [[nodiscard]] Constraints constraints() const;
};

/// Fills holes of a mesh. Of all triangulations of a rim it takes the one whose greatest dihedral angle, between its
/// triangles and to the faces around, is least, and of equal ones that of least area (G. Barequet and M. Sharir,
/// Filling gaps in the boundary of a polyhedron, 1995; P. Liepa, Filling holes in meshes, 2003). Where a rim has more
/// than 500 edges, ears are cut off first. Triangles are split until they are as dense as the faces around, and edges
/// swapped where that makes triangles rounder (Liepa). Patches are then faired with restrict_to_region() and fair(), so
/// that they share tangent planes with the faces around; patches that touch are faired together. New faces are oriented
/// as those around. Faces of another part that lie within a hole are not joined to it.
///
/// Nodes and faces of the input keep their numbers and places. A patch that fairing would make cross more faces is not
/// faired. The result has the same bits for every number of threads. When cancelled, holes not triangulated yet stay
/// open, and patches not faired yet stay as they are.
///
/// Throws what FillOptions::validate() throws, and Error(unusable_constraint) naming a node of `at` that lies at no
/// hole. Cost: linear in the mesh (n log n to look for crossings); cubic in the edges of a rim, a second for 500; then
/// that of fair() for each patch.
[[nodiscard]] FilledHoles fill_holes(const PolygonMesh& mesh, const FillOptions& options, Context& context);
[[nodiscard]] FilledHoles fill_holes(const PolygonMesh& mesh, const FillOptions& options = {});

/// Appends the patches to a file: its mesh gets their nodes, at their positions after fairing, and their faces, and
/// `added` says what these take from the file, so that writing keeps all that it carried. Each patch is a group of OBJ,
/// "hole_17" by the first node of its rim, with "_" behind where the file has that group. Patches that were appended
/// before stay.
///
/// filled: of the mesh of the file, or of the mesh that weld() makes of it. Throws Error(invalid_argument) for a mesh
/// of another size. Cost: linear.
void add_patches(SurfaceFile& file, const FilledHoles& filled);

}  // namespace vspring
