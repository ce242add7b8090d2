#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Predicts where moving nodes go in the next step of a drag, from how they followed the held nodes in the last steps
/// (multisecant prediction).
class MultisecantPredictor {
 public:
  /// Adds a step. held: of held nodes, not all zero, with the same number of vectors in every call; moving: of moving
  /// nodes.
  void remember(std::vector<Vector3> held, std::vector<Eigen::Vector3f> moving);

  /// Finds the combination of stored steps nearest to `held`; adds its step of the moving nodes to `moving`, and leaves
  /// the residual in `held`. Cost: linear.
  void predict(std::span<Vector3> held, std::span<Vector3> moving) const;

 private:
  struct Step {
    std::vector<Vector3> held;
    std::vector<Eigen::Vector3f> moving;
  };
  std::vector<Step> steps_;  // the newest last
};

}  // namespace vspring
