#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "spring/net.hpp"

namespace vspring {

/// Keeps the nodes of a closed surface without held nodes from drifting along it: points pull along normals only, and
/// the regularisation (§4.4) asks for an even distribution, not for a place. On a sphere, translations and rotations of
/// the whole, projected across the normals, nearly preserve an even distribution. These fields are removed from the
/// regularisation and from steps, in each component that is not held.
class TangentialRigidModes {
 public:
  /// Cost: linear.
  explicit TangentialRigidModes(const Net& net);

  /// Whether any component is not held.
  [[nodiscard]] bool needed() const noexcept { return count_ > 0; }

  /// Removes these fields from vectors across the normals, one for each moving node. Cost: linear.
  void hold(std::span<Vector3> vectors) const;

 private:
  const Net* net_;
  std::vector<std::uint32_t> component_;  // per moving node, among components not held; their number if it is held
  std::size_t count_ = 0;
};

}  // namespace vspring
