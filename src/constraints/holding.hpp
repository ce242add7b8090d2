#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/error.hpp"

namespace vspring {

/// Moving nodes that cannot move: nodes whose faces form several fans or meet more than two at an edge, and all nodes
/// of faces at edges of four or more. Lists all of them, some repeatedly. See ImmovableNodesFixed.
class ImmovableNodes : public Error {
 public:
  ImmovableNodes(const std::string& message, std::vector<Index> nodes)
      : Error(ErrorCode::unusable_shape, message), nodes_(std::move(nodes)) {}
  [[nodiscard]] const std::vector<Index>& nodes() const noexcept { return nodes_; }

 private:
  std::vector<Index> nodes_;
};

/// As the public check_constraints(), but scattered points hold the shape, too. pulled: one entry per node, 1 where
/// points are tied to it; empty: none. Throws ImmovableNodes for moving nodes that cannot move.
std::vector<Warning> check_constraints(const PolygonMesh& mesh, const Constraints& constraints,
                                       std::span<const std::uint8_t> pulled);
std::vector<Warning> check_constraints(const PolygonCurve& curve, const Constraints& constraints,
                                       std::span<const std::uint8_t> pulled);

/// Checks a curve that is cut at its corners.
std::vector<Warning> check_sides(const PolygonCurve& sides, const Constraints& held);

/// Throws Error(unusable_constraint) if constraints of a surface name corners. Cost: none if they do not.
void refuse_corners(const Constraints& of_surface);

/// Throws Error(unusable_constraint) naming a node that slides, with the reason why it cannot. Cost: none if none does.
void refuse_sliding(const Constraints& constraints, const char* why);

/// Whether nodes of the boundary slide. Cost: none if none does.
[[nodiscard]] bool slides_at_boundary(const PolygonMesh& mesh, const Constraints& constraints);

/// Where nodes that slide are on their supports.
class PlacesOnSupports {
 public:
  /// positions: of all nodes. Cost: none if no node slides. Memory: that of the
  /// constraints, if one does.
  PlacesOnSupports(const std::vector<Vector3>& positions, const Constraints& constraints);

  /// The place nearest to a position that the node may have: that itself, if it does not slide. Throws
  /// Error(unusable_constraint) naming the node if no place is the nearest, or it is further away than the size of the
  /// shape.
  [[nodiscard]] Vector3 operator()(Index node, const Vector3& position) const;

  /// What the node slides on; null if it does not.
  [[nodiscard]] const Support* support(Index node) const;

 private:
  Constraints constraints_;  ///< of no nodes, where none slides
  double size_ = 0;
};

}  // namespace vspring
