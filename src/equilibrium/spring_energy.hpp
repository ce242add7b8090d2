#pragma once

#include "spring/net.hpp"

namespace vspring {

/// What tells equilibria of one surface apart: bent more sharply than their level can show, some are folds that the
/// shape was caught in.
struct SpringEnergy {
  /// Σ ((t_j − t_i)/ℓ)² (Eq. 4) over the edges of moving nodes, and those between held neighbours of moving nodes,
  /// whose springs change with these.
  double sum = 0;
  double least_cosine = 1;  ///< of the angle between normals at the edges of moving nodes
};

/// Needs directions. Cost: linear.
SpringEnergy spring_energy(const Net& net);

}  // namespace vspring
