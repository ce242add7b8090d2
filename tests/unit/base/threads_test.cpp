#include "base/threads.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace vspring {
namespace {

TEST(Threads, EveryTaskIsDoneOnce) {
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.size(), threads);
    for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
      std::vector<int> done(count, 0);
      team.run(count, [&](std::size_t k) { ++done[k]; });
      EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), static_cast<int>(count));
      for (const int times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Threads, ManyShortRunsFollowEachOther) {
  ThreadTeam team(4);
  std::vector<long> values(64, 0);
  for (int round = 0; round < 2000; ++round) {
    team.run(values.size(), [&](std::size_t k) { values[k] += static_cast<long>(k); });
  }
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_EQ(values[k], static_cast<long>(2000 * k));
}

TEST(Threads, RangesCoverEverythingWithoutOverlap) {
  ThreadTeam team(3);
  std::vector<int> seen(1003, 0);
  parallel_ranges(team, seen.size(), 10, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++seen[i];
  });
  for (const int times : seen) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace vspring
