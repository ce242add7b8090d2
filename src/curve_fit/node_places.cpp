#include "curve_fit/node_places.hpp"

#include <algorithm>
#include <cstddef>

namespace vspring {

namespace {

// Least distance, as a share of the mean distance of values around; and how many of these on either side.
constexpr double least_share_of_mean = 0.1;
constexpr std::size_t values_about = 8;

}  // namespace

void set_in_order(std::vector<double>& values, double apart, double least, double most) {
  const std::size_t count = values.size();
  if (count == 0) return;
  std::vector<double> sorted = values;
  for (double& value : sorted) value = std::clamp(value, least, most);
  std::sort(sorted.begin(), sorted.end());
  // The least distance of value k from `least`.
  std::vector<double> from(count + 1);
  double sum = 0;
  for (std::size_t k = 0; k <= count; ++k) {
    const std::size_t first = k > values_about ? k - values_about : 0;
    const std::size_t last = std::min(count + 1, k + values_about);
    const auto at = [&](std::size_t n) { return n == 0 ? least : n > count ? most : sorted[n - 1]; };
    sum += std::max(apart, least_share_of_mean * (at(last) - at(first)) / static_cast<double>(last - first));
    from[k] = sum;
  }
  const double scale = std::min(1.0, (most - least) / sum);
  for (double& one : from) one *= scale;
  struct Pool {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (std::size_t k = 0; k < count; ++k) {
    pools.push_back({sorted[k] - least - from[k], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::size_t k = 0;
  const double spare = std::max(0.0, most - least - from[count]);
  for (const Pool& pool : pools) {
    for (std::size_t n = 0; n < pool.count; ++n, ++k) values[k] = least + from[k] + std::clamp(pool.mean(), 0.0, spare);
  }
}

}  // namespace vspring
