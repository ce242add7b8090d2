#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/error.hpp"

namespace vspring {

/// Nodes that would have to move and cannot, as their faces form several fans or more than two meet at an edge, and
/// those of all faces at edges of four or more: all of them, once or more often. See ImmovableNodesFixed.
class ImmovableNodes : public Error {
 public:
  ImmovableNodes(const std::string& message, std::vector<Index> nodes)
      : Error(ErrorCode::unusable_shape, message), nodes_(std::move(nodes)) {}
  [[nodiscard]] const std::vector<Index>& nodes() const noexcept { return nodes_; }

 private:
  std::vector<Index> nodes_;
};

/// As the public ones, where scattered points hold a shape too. pulled: one entry per node, 1 where points are tied to
/// it; empty: none. Throws ImmovableNodes where nodes would have to move that cannot.
std::vector<Warning> check_constraints(const PolygonMesh& mesh, const Constraints& constraints,
                                       std::span<const std::uint8_t> pulled);
std::vector<Warning> check_constraints(const PolygonCurve& curve, const Constraints& constraints,
                                       std::span<const std::uint8_t> pulled);

/// The same for a curve that is cut at its corners.
std::vector<Warning> check_sides(const PolygonCurve& sides, const Constraints& held);

/// Throws Error(unusable_constraint) for constraints of a surface that name corners. Cost: none, where they do not.
void refuse_corners(const Constraints& of_surface);

}  // namespace vspring
