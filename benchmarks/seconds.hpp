#pragma once

#include <algorithm>
#include <chrono>

namespace vspring::bench {

/// What a call takes.
template <typename Call>
double seconds(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The least of so many calls.
template <typename Call>
double best_seconds(int times, const Call& call) {
  double best = seconds(call);
  for (int k = 1; k < times; ++k) best = std::min(best, seconds(call));
  return best;
}

}  // namespace vspring::bench
