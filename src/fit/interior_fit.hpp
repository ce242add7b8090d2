#pragma once

#include <optional>

#include "fit/tolerance_fit.hpp"

namespace vspring {

/// The side of its shape on which a point lies; none where there are more than two, on curves in space.
class Sides {
 public:
  static std::optional<Sides> of(const Net& net);

  /// The direction across the shape at a node, unit or zero. Needs directions.
  [[nodiscard]] Vector3 across(const Net& net, std::size_t node) const;

  /// A number with the sign of the side of a node and its edges on which a point is not.
  [[nodiscard]] double side(const Net& net, std::size_t node, const Vector3& point) const;

 private:
  Vector3 plane_ = Vector3::Zero();  ///< of a curve: the normal of its plane
};

/// The shape of least bending whose points all lie within the tolerance, from one whose points about do: by a
/// primal-dual interior-point method (S. J. Wright, "Primal-Dual Interior-Point Methods", SIAM 1997), each of whose
/// steps is an equilibrium. A point pulls by how steep the barrier of its two bounds is, to where the barrier's slope
/// asks; as the barrier falls, points inside come to pull at nothing and those at the bound by just enough. As bending
/// falls, curvature comes to change at once where single points hold: the way ends where energy has risen by a tenth.
/// Leaves the shape in the net.
ToleranceFitResult hold_between(const ToleranceFitTask& task, const Sides& sides, double tolerance,
                                ToleranceFitResult smooth);

}  // namespace vspring
