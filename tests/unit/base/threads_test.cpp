#include "base/threads.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

namespace vspring::threads_test {
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

TEST(Threads, WhatATaskThrowsReachesTheCallerWhenNobodyWorksAnyMore) {
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    for (const std::size_t faulty : {0U, 7U, 99U}) {
      std::atomic<int> busy = 0;
      const auto task = [&](std::size_t k) {
        ++busy;
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        --busy;
        if (k == faulty) throw std::bad_alloc();
      };
      EXPECT_THROW(team.run(100, task), std::bad_alloc);
      EXPECT_EQ(busy, 0);
      std::atomic<int> done = 0;
      team.run(100, [&](std::size_t) { ++done; });
      EXPECT_EQ(done, 100) << "the team goes on";
    }
  }
}

TEST(Threads, TeamsSideBySideHelpNobodyElse) {
  std::vector<std::thread> callers;
  std::vector<std::vector<int>> done(4);
  callers.reserve(done.size());
  for (auto& mine : done) {
    callers.emplace_back([&mine] {
      for (int k = 0; k < 200; ++k) {
        ThreadTeam outer(3);
        ThreadTeam inner(2);
        mine.resize(mine.size() + 20);
        outer.run(10, [&](std::size_t i) { mine[mine.size() - 20 + i] = 1; });
        inner.run(10, [&](std::size_t i) { mine[mine.size() - 10 + i] = 1; });
      }
    });
  }
  for (auto& caller : callers) caller.join();
  for (const auto& mine : done) EXPECT_EQ(std::accumulate(mine.begin(), mine.end(), 0), 200 * 20);
}

TEST(Threads, ServeOneTeamAfterTheOther) {
  std::set<pid_t> seen;
  std::mutex mutex;
  for (int k = 0; k < 200; ++k) {
    ThreadTeam team(2);
    team.run(4, [&](std::size_t) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      const std::lock_guard lock(mutex);
      seen.insert(gettid());
    });
  }
  EXPECT_GT(seen.size(), 1U);
  EXPECT_LT(seen.size(), 20U);
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
}  // namespace vspring::threads_test
