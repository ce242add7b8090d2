#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// How moving nodes went with what holds them in the last steps of a drag, and so where they will go in the next: the
/// multisecant prediction.
class MultisecantPredictor {
 public:
  /// A step that was made: of what holds, not all zero, as many vectors whenever it is called, and of the moving nodes.
  void remember(std::vector<Vector3> held, std::vector<Eigen::Vector3f> moving);

  /// Of the combination of remembered steps that is nearest to the step `held` of what holds: adds to `moving` the way
  /// of the moving nodes, and leaves in `held` what it does not make up for. Cost: linear.
  void predict(std::span<Vector3> held, std::span<Vector3> moving) const;

 private:
  struct Step {
    std::vector<Vector3> held;
    std::vector<Eigen::Vector3f> moving;
  };
  std::vector<Step> steps_;  // the newest last
};

}  // namespace vspring
