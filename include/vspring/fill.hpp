#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// What has become of a hole.
enum class HoleState : std::uint8_t {
  open,        ///< nobody has looked at it yet
  filled,      ///< by faces of FilledHoles::mesh
  outer_rim,   ///< left open as the outer rim of a sheet, see Hole::is_outer_rim()
  too_large,   ///< left open as it is larger than FillOptions says
  elsewhere,   ///< left open as it is not at a node of FillOptions::at
  unfillable,  ///< left open, see Hole::fault
  cancelled    ///< left open as the call was cancelled before
};

/// "open", "filled", "outer-rim", "too-large", "elsewhere", "unfillable" or "cancelled".
[[nodiscard]] const char* name(HoleState state) noexcept;

/// Why no faces can fill a hole. Hole::fault_node is the node that is named.
enum class HoleFault : std::uint8_t {
  none,
  not_finite,        ///< a coordinate of the rim is not finite
  non_manifold,      ///< an edge of more than two faces, or a face that has the node twice, is at the rim
  orientation,       ///< faces along the rim run in different directions
  no_triangulation,  ///< edges that would be needed join its nodes outside already
  folded             ///< each triangulation folds back onto itself or onto the faces around, or has no area
};

/// A closed loop of boundary edges of a mesh.
struct Hole {
  /// Its nodes, the least first, in the order in which faces that fill it run along it; no node twice.
  std::vector<Index> rim;
  double length = 0;  ///< of the rim, in units of the mesh
  /// How much faces at the rim face as the rim goes around, from 1 to −1: the cosine between their mean normal, by
  /// area, and the normal of the polygon that they run along; 1 around a flat sheet, 0 at the end of a tube, near −1
  /// for a small hole in a smooth surface.
  double facing = 0;
  HoleState state = HoleState::open;
  HoleFault fault = HoleFault::none;
  Index fault_node = -1;
  // Filled: the nodes and faces that came to the mesh, consecutive.
  Index first_node = -1;
  Index node_count = 0;
  Index first_face = -1;
  Index face_count = 0;
  /// How its fairing ended, together with holes that it touches; empty where none of its nodes is new, or none was
  /// asked for.
  std::optional<Outcome> outcome = std::nullopt;

  /// Whether `facing` is more than a half, as that of a cap of a sphere up to 60° from its middle.
  [[nodiscard]] bool is_outer_rim() const noexcept;
};

/// In words for people, in one line: why, where, and what to do; empty for HoleFault::none.
[[nodiscard]] std::string fault_message(const Hole& hole);

/// The holes of a mesh, by their first nodes; at nodes where several meet they are told apart. Those of which it is
/// plain already have state `unfillable`. Chains of boundary edges that end at an edge of more than two faces are such,
/// too. Cost: linear.
[[nodiscard]] std::vector<Hole> find_holes(const PolygonMesh& mesh);

struct FillOptions {
  /// Only holes through these nodes, outer rims among them. Empty: all but outer rims.
  std::vector<Index> at = {};
  /// Fill outer rims as well.
  bool outer_rims = false;
  /// Only holes whose rim is no longer than this, in units of the mesh.
  std::optional<double> most_length = std::nullopt;
  /// Only holes whose rim has no more edges than this.
  std::optional<Index> most_edges = std::nullopt;
  /// Leave patches flat: triangulated and refined, with creases at the rim.
  bool flat = false;
  /// How patches are faired. Boundaries, points and the like have no say.
  FairOptions fair = {};

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;
};

/// A mesh with its holes filled.
struct FilledHoles {
  /// The mesh, and behind its nodes and faces those of the patches, hole by hole. New nodes are where patches are flat.
  PolygonMesh mesh;
  /// The same nodes where patches are fair; those of the input to the bit.
  std::vector<Vector3> positions;
  /// Per new node the rim node that is nearest along the patch, and per new face the input's face beside the rim there:
  /// whose colours and the like it may take.
  std::vector<Index> node_like;
  std::vector<Index> face_like;
  std::vector<Hole> holes;  ///< as of find_holes()
  /// Of the fairing of all patches: the worst outcome, sums of work. Warnings name the hole, and tell of those that
  /// cannot be filled and of patches that cross other faces.
  FairReport report;

  /// Whether report.usable(), and no hole that was to be filled is left open, as HoleState::unfillable.
  [[nodiscard]] bool usable() const noexcept;

  /// Which nodes moved in fairing: all new ones.
  [[nodiscard]] Constraints constraints() const;
};

/// Fills holes of a mesh: with the triangles over the rim whose greatest dihedral angle, among each other and with the
/// faces around, is least, then whose area is least (G. Barequet and M. Sharir, Filling gaps in the boundary of a
/// polyhedron, 1995; P. Liepa, Filling holes in meshes, 2003); of rims of more than 500 edges ears are cut off first.
/// Triangles are split until they are as dense as the faces around, and edges swapped where triangles become rounder
/// (Liepa). Patches are then faired as restrict_to_region() and fair() do, so that they meet what is around with one
/// tangent plane; holes that touch together, others one by one. New faces run as those around do. Faces that lie within
/// a hole and belong to another part are not joined to it.
///
/// Nodes and faces of the input keep their numbers and places. A patch that would cross more faces than when it is flat
/// stays flat. The result has the same bits for every number of threads. Where the context is cancelled, holes that are
/// not triangulated yet stay open and patches that are not faired yet flat.
///
/// Throws Error(invalid_argument) as FillOptions::validate() does, and Error(unusable_constraint) naming a node of `at`
/// that lies at no hole. Cost: linear in the mesh (n log n to look for crossings); cubic in the edges of a rim up to
/// 500, a second for these; then as fair() for each patch.
[[nodiscard]] FilledHoles fill_holes(const PolygonMesh& mesh, const FillOptions& options, Context& context);
[[nodiscard]] FilledHoles fill_holes(const PolygonMesh& mesh, const FillOptions& options = {});

}  // namespace vspring
