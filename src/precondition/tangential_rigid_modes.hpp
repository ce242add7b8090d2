#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "spring/net.hpp"

namespace vspring {

/// What keeps the nodes of a closed surface from drifting along it where no node of it is held: points pull along
/// normals only, and the regularisation (§4.4) asks for an even distribution, not for a place. On a sphere, what shifts
/// and turns of the whole are across the normals leaves a distribution even, nearly. Those fields are taken out of what
/// the regularisation asks and out of steps, in each component of the surface that is not held.
class TangentialRigidModes {
 public:
  /// Cost: linear.
  explicit TangentialRigidModes(const Net& net);

  /// Whether anything is not held.
  [[nodiscard]] bool needed() const noexcept { return count_ > 0; }

  /// Takes those fields out of vectors across the normals, one for each moving node. Cost: linear.
  void hold(std::span<Vector3> vectors) const;

 private:
  const Net* net_;
  std::vector<std::uint32_t> component_;  // of every moving node among those not held; their number where it is held
  std::size_t count_ = 0;
};

}  // namespace vspring
