#pragma once

#include <vector>

namespace vspring {

/// Moves values as little as it takes, in the sum of squares, to come one after the other, from `least` to `most` and
/// by no less than a tenth of what they are apart on average about there, or `apart`. Cost: n log n (pool adjacent
/// violators; Barlow, Bartholomew, Bremner and Brunk 1972).
void set_in_order(std::vector<double>& values, double apart, double least, double most);

}  // namespace vspring
