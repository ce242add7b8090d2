#pragma once

#include <vector>

#include "vspring/fairness.hpp"

namespace vspring::support {

struct BeforeAndAfter {
  Fairness before;
  Fairness after;
};

/// The fairness of a shape before and with other positions, where it moves under these constraints.
template <typename Shape>
BeforeAndAfter fairness_of(const Shape& shape, const Constraints& constraints, const std::vector<Vector3>& positions) {
  Shape after = shape;
  after.set_positions(positions);
  return {measure(shape, &constraints), measure(after, &constraints)};
}

}  // namespace vspring::support
