#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vspring {

/// The median of `values`, which must not be empty; of an even number the greater of the two middle ones. Reorders
/// `values`. Cost: linear.
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace vspring
