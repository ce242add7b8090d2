#pragma once

// Methods for tests.

#include <optional>

#include "vspring/fair.hpp"

namespace vspring::support {

/// The equilibrium, or the nearest shape found; no fallbacks.
inline EquilibriumMethod equilibrium_alone(double tolerance = 1e-5) {
  return {.tolerance = tolerance, .fallbacks = false};
}

}  // namespace vspring::support
