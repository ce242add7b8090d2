#pragma once

#include <chrono>

namespace vspring::bench {

/// What a call takes.
template <typename Call>
double seconds(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace vspring::bench
