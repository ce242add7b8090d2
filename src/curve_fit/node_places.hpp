#pragma once

#include <vector>

namespace vspring {

/// Sorts values, so that rows out of order have the places of all of them, and moves them as little as it takes, in the
/// sum of squares, to lie between `least` and `most` and no less apart than a tenth of the average about there, or
/// `apart`. Cost: n log n (pool adjacent violators; Barlow, Bartholomew, Bremner and Brunk 1972).
void set_in_order(std::vector<double>& values, double apart, double least, double most);

}  // namespace vspring
