#pragma once

#include <vector>

namespace vspring {

/// Sorts values, so that rows out of order exchange places, and moves them, with the least sum of squares, to lie
/// between `least` and `most`, and apart by at least `apart` and a tenth of the mean distance around. Cost: n log n
/// (pool adjacent violators; Barlow, Bartholomew, Bremner and Brunk 1972).
void set_in_order(std::vector<double>& values, double apart, double least, double most);

}  // namespace vspring
