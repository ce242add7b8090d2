#pragma once

#include <vector>

#include "vspring/fit.hpp"

namespace vspring {

/// Throws Error(invalid_argument) naming a point that fit() does not take.
void check_points(const ScatteredPoints& points);

/// What there is to say of the distances of one point or more.
PointDistances summary(std::vector<double> distances);

}  // namespace vspring
