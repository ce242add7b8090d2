#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/support.hpp"
#include "vspring/warning.hpp"

namespace VSPRING_API vspring {

/// The sides of a node of a curve, in the order of its chain.
enum class NodeSide : std::uint8_t { before, after };

inline constexpr NodeSide node_sides[] = {NodeSide::before, NodeSide::after};

/// What each node of a shape may do (paper §4.5, direct constraints): its position is fixed, free, or free along a
/// support, its normal given or computed, in any combination. Nodes of curves may also have a tangent given, or be
/// corners.
class Constraints {
 public:
  /// All positions and normals free.
  explicit Constraints(Index node_count);

  /// Number of nodes, of which each has its own constraints.
  [[nodiscard]] Index node_count() const noexcept { return static_cast<Index>(flags_.size()); }

  /// Holds the node at `position`, in units of the shape. check_constraints() refuses a position that is not finite
  /// where a moving node depends on it. The node stops sliding.
  void fix_position(Index node, const Vector3& position);
  /// Lets the node move in all directions.
  void free_position(Index node);
  /// Whether the node is held at position().
  [[nodiscard]] bool position_fixed(Index node) const { return (flags_[at(node)] & position_flag) != 0; }
  /// Meaningful where position_fixed().
  [[nodiscard]] const Vector3& position(Index node) const { return positions_.of(at(node)); }

  /// Surfaces: lets the node move along the support, and nowhere else; from its present position it starts at the
  /// nearest place there. Across the surface the springs around it move it, as they move a free node. One at the
  /// boundary of the mesh needs a given normal, and goes straight ahead along its support; the surface ends there so
  /// that its mean curvature does not change across the end. A fixed position is freed.
  void slide_on(Index node, const Support& support) { slide_on(std::span(&node, 1), support); }
  /// Lets each of these nodes move along the support, which is stored once.
  void slide_on(std::span<const Index> nodes, const Support& support);
  /// What the node slides on; null if it does not slide.
  [[nodiscard]] const Support* support(Index node) const {
    const std::size_t i = at(node);
    return i < supports_.size() ? supports_[i].get() : nullptr;
  }
  /// Number of nodes that slide.
  [[nodiscard]] Index sliding_count() const noexcept { return sliding_count_; }

  /// Gives the node a normal of any length but zero; either sense will do. Throws Error(unusable_constraint) naming the
  /// node when it is zero or not finite.
  void fix_normal(Index node, const Vector3& normal);
  /// Lets the normal follow from the nodes around.
  void free_normal(Index node);
  /// Whether the node has a given normal().
  [[nodiscard]] bool normal_fixed(Index node) const { return (flags_[at(node)] & normal_flag) != 0; }
  /// Unit length; meaningful where normal_fixed().
  [[nodiscard]] const Vector3& normal(Index node) const { return normals_.of(at(node)); }

  /// Curves: gives the node a tangent of any length but zero, in the direction in which the curve runs. The node stops
  /// being a corner. Throws Error(unusable_constraint) naming the node when it is zero or not finite.
  void fix_tangent(Index node, const Vector3& tangent);
  /// Frees the node's tangent, at a corner those of both sides. A corner stays a corner.
  void free_tangent(Index node);
  /// Whether the node has one given tangent() for both sides.
  [[nodiscard]] bool tangent_fixed(Index node) const { return (flags_[at(node)] & tangent_flag) != 0; }
  /// Unit length; meaningful where tangent_fixed().
  [[nodiscard]] const Vector3& tangent(Index node) const { return tangents_.of(at(node)); }

  /// Curves: makes the node a corner, as FairOptions::corners does: direction and curvature may jump there, and each
  /// side may have its own tangent. The node must lie inside a chain.
  void make_corner(Index node);
  /// Makes the node an ordinary one; tangents of its sides are freed.
  void free_corner(Index node);
  /// Whether make_corner() or a tangent of one side has made the node a corner.
  [[nodiscard]] bool corner(Index node) const { return (flags_[at(node)] & corner_flag) != 0; }
  /// Number of corners.
  [[nodiscard]] Index corner_count() const noexcept { return corner_count_; }

  /// Makes the node a corner and gives one side its tangent: the direction in which the curve arrives (before) or
  /// leaves (after). Throws as fix_tangent() for both sides does.
  void fix_tangent(Index node, const Vector3& tangent, NodeSide side);
  /// Frees the tangent of one side. A corner stays a corner.
  void free_tangent(Index node, NodeSide side) { flags_[at(node)] &= static_cast<std::uint8_t>(~flag_of(side)); }
  /// Whether this side has a tangent, of its own or that of both sides.
  [[nodiscard]] bool tangent_fixed(Index node, NodeSide side) const {
    return (flags_[at(node)] & (tangent_flag | flag_of(side))) != 0;
  }
  /// Unit length; meaningful where tangent_fixed() on that side.
  [[nodiscard]] const Vector3& tangent(Index node, NodeSide side) const {
    return tangent_fixed(node) || side == NodeSide::before ? tangent(node) : tangents_after_.of(at(node));
  }

  /// Appends free nodes.
  void add_nodes(Index count);
  /// Gives `node` exactly what `other`, which may be this object, says of its node `of`.
  void hold_as(Index node, const Constraints& other, Index of);

 private:
  static constexpr std::uint8_t position_flag = 1;
  static constexpr std::uint8_t normal_flag = 2;
  static constexpr std::uint8_t tangent_flag = 4;
  static constexpr std::uint8_t corner_flag = 8;
  static constexpr std::uint8_t flag_of(NodeSide side) { return side == NodeSide::before ? 16 : 32; }
  /// Throws Error(unusable_constraint) for a node number out of range.
  [[nodiscard]] std::size_t at(Index node) const {
    if (node < 0 || node >= node_count()) refuse(node);
    return static_cast<std::size_t>(node);
  }
  [[noreturn]] void refuse(Index node) const;
  void slide_on(Index node, std::shared_ptr<const Support> support);
  void stop_sliding(Index node);

  /// A vector for some of the nodes: most have no constraint of most kinds.
  class Vectors {
   public:
    /// Zero for a node without a vector.
    [[nodiscard]] const Vector3& of(std::size_t node) const;
    void set(std::size_t node, std::size_t node_count, const Vector3& value);

   private:
    std::vector<std::uint32_t> place_;  // of every node's vector; the first one stands for all that have none
    std::vector<Vector3> values_;
  };

  std::vector<std::uint8_t> flags_;
  Vectors positions_;
  Vectors normals_;
  Vectors tangents_;  ///< of both sides, or that before a corner
  Vectors tangents_after_;
  Index corner_count_ = 0;
  std::vector<std::shared_ptr<const Support>> supports_;  ///< by node, none for those that do not slide; empty: none do
  Index sliding_count_ = 0;
};

/// Fixes the boundary nodes of the mesh, or the end nodes of the curve, at their present positions. Cost: linear.
void fix_boundary_positions(Constraints& constraints, const PolygonMesh& mesh);
void fix_boundary_positions(Constraints& constraints, const PolygonCurve& curve);

/// Gives the boundary nodes the normals of the mesh there, by estimate_normals(). Cost: linear.
void fix_boundary_normals(Constraints& constraints, const PolygonMesh& mesh);

/// Gives the end nodes the tangents of the curve there, by estimate_tangents(). Cost: linear.
void fix_boundary_tangents(Constraints& constraints, const PolygonCurve& curve);

/// Estimates the normals of a mesh at some of its nodes, in the sense of the faces. Each comes from a least-squares fit
/// of e·N = c|e|² + a quadratic form without trace, over the edges e to the nodes around. Exact on spheres and planes,
/// of second order in the spacing elsewhere, also at boundaries.
///
/// nodes: where. usable_face: one entry per face, 0 for a face to leave out; empty: use all. Returns one unit vector
/// per entry of nodes; zero where no usable face touches the node. Cost: linear preparation, then proportional to the
/// nodes asked for.
[[nodiscard]] std::vector<Vector3> estimate_normals(const PolygonMesh& mesh, std::span<const Index> nodes,
                                                    std::span<const std::uint8_t> usable_face = {});

/// Estimates the tangents of a curve at some of its nodes: of the circle through the node and its neighbours (at an end
/// the next two nodes), or of the edge where there is no third node. Exact on circles, of second order in the spacing
/// elsewhere.
///
/// nodes: where. usable_node: one entry per node, 0 for a node to leave out; empty: use all. Returns one unit vector
/// per entry of nodes, along the first chain that has the node; zero where no edge gives a direction. Cost: linear.
[[nodiscard]] std::vector<Vector3> estimate_tangents(const PolygonCurve& curve, std::span<const Index> nodes,
                                                     std::span<const std::uint8_t> usable_node = {});

/// Estimates tangents from one side of each node alone: of the circle through it and the next two nodes on that side.
/// Returns and costs what estimate_tangents() without a side does.
[[nodiscard]] std::vector<Vector3> estimate_tangents(const PolygonCurve& curve, std::span<const Index> nodes,
                                                     NodeSide side);

/// The normals of a curve at some of its nodes: perpendicular to estimate_tangents(), in the plane of a planar curve,
/// along the principal normal of a space curve. Returns one unit vector per entry of nodes; zero where a node has none.
/// Cost: linear.
[[nodiscard]] std::vector<Vector3> estimate_normals(const PolygonCurve& curve, std::span<const Index> nodes);

/// Whether the curve, its fixed positions and its given directions lie in one plane, to 1e-9 of their extent. Then
/// fairing keeps it in that plane, and CurveRules::normal_plane makes no difference. False for a straight line. Ignores
/// coordinates that are not finite. Throws Error(unusable_constraint) for constraints of fewer nodes. Cost: linear.
[[nodiscard]] bool lies_in_a_plane(const PolygonCurve& curve, const Constraints& constraints);

/// Fixes all nodes outside `region` at their present positions. Constraints on nodes of the region stay.
///
/// The normals of the rim (fixed nodes next to moving ones) are computed in every iteration from all faces around them,
/// so the faired patch meets the rest smoothly. Rim nodes at the boundary of the mesh have faces on one side only: they
/// get the tangent plane of the faces without a moving node, to second order. Where there is no such face the normal
/// stays free, and the patch may turn about the node. Throws Error(unusable_constraint) naming a node out of range.
/// Cost: linear.
void restrict_to_region(Constraints& constraints, const PolygonMesh& mesh, std::span<const Index> region);

/// Fixes all nodes of a curve outside `region` at their present positions, and gives the rim the tangents of the part
/// outside. Throws and costs what restrict_to_region() of a surface does.
void restrict_to_region(Constraints& constraints, const PolygonCurve& curve, std::span<const Index> region);

/// Checks that a surface can be faired under these constraints.
///
/// Throws Error(unusable_constraint), with the reason and ways out, for a component with moving nodes that no fixed
/// node holds, for a boundary loop with fewer than three nodes that are fixed or slide, for corners, for a node that
/// slides at a boundary without a given normal, and for one that lies further from what it slides on than the shape is
/// large or has no nearest place there; Error(unusable_shape) where a face of a moving node has fewer than three nodes
/// or a coordinate is not finite.
///
/// Returns warnings: of nodes that are held because they cannot move (edges of more than two faces, faces in several
/// fans, repeated nodes and faces) or slide (the surface lies within 6° of along their support there); of a closed
/// surface held by so little that more than one sphere fits; of free boundary nodes, which will be drawn in. Cost:
/// linear.
std::vector<Warning> check_constraints(const PolygonMesh& mesh, const Constraints& constraints);

/// Checks that a curve can be faired under these constraints. Throws Error(unusable_constraint) for free ends, for
/// closed chains without a held node, for nodes that slide, and for corners that have a normal or lie at an end or
/// where chains meet;
/// Error(unusable_shape) for a moving node where chains meet, in a closed chain of fewer than three nodes, or with a
/// coordinate that is not finite. Warns of closed chains held by so little that more than one circle fits. Cost:
/// linear.
std::vector<Warning> check_constraints(const PolygonCurve& curve, const Constraints& constraints);

}  // namespace vspring
