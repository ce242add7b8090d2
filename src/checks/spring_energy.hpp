#pragma once

#include "spring/net.hpp"

namespace vspring {

/// What tells equilibria of one surface apart: bent more sharply than their level can show, some are folds that the
/// shape was caught in.
struct SpringEnergy {
  double sum = 0;           ///< Σ over edges ((t_j − t_i)/ℓ)² (Eq. 4)
  double least_cosine = 1;  ///< of the angle between normals of neighbours
};

/// Needs directions. Cost: linear.
SpringEnergy spring_energy(const Net& net);

}  // namespace vspring
