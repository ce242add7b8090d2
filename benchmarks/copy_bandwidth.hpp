#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "base/threads.hpp"
#include "seconds.hpp"

namespace vspring::bench {

/// Bytes a second that the machine moves when it copies arrays far larger than its caches, read and write counted.
inline double copy_bandwidth(ThreadTeam& team) {
  const std::size_t doubles = std::size_t{1} << 25;
  std::vector<double> from(doubles, 1.0);
  std::vector<double> to(doubles, 0.0);
  const auto copy = [&] {
    parallel_ranges(team, doubles, doubles / 16, [&](std::size_t begin, std::size_t end) {
      std::memcpy(to.data() + begin, from.data() + begin, (end - begin) * sizeof(double));
    });
  };
  return 2.0 * static_cast<double>(doubles * sizeof(double)) / best_seconds(5, copy);
}

}  // namespace vspring::bench
