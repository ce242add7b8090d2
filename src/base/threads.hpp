#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <typeinfo>
#include <vector>

namespace vspring {

/// A team of threads that works on numbered tasks. Any thread may take any task, so tasks must not depend on each other
/// or on the thread: then results have the same bits for every size of team. Helpers live as long as the program and
/// serve one team after the other. If no more can be started, fewer do the work.
class ThreadTeam {
 public:
  /// threads: at least 1, the caller among them.
  explicit ThreadTeam(int threads) : size_(threads) {}
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  [[nodiscard]] int size() const noexcept { return size_; }

  /// How often teams of this program have called for helpers: shows whether something ran on several threads.
  [[nodiscard]] static std::size_t calls_for_help() noexcept;

  /// From now on calls `see` with the type of every function that a team shares out. For tests; set it before any team
  /// works.
  static void watch(void (*see)(const std::type_info& work)) noexcept;

  /// Calls task(k) for k from 0 to count − 1 and returns when all are done. If a task throws, tasks that have not begun
  /// are skipped, and one of the exceptions is rethrown when all threads have stopped. The calling thread calls
  /// end_if_cancelled() before each of its tasks.
  void run(std::size_t count, const std::function<void(std::size_t)>& task);

 private:
  friend class WorkerPool;

  /// The loop of a helper: works until there has been nothing to do for a while.
  void help();
  void take_tasks(const std::function<void(std::size_t)>& task, std::size_t count);

  int size_;
  std::mutex mutex_;
  std::condition_variable finished_;
  int helpers_ = 0;  // at work or called
  std::atomic<std::uint64_t> round_ = 0;
  std::atomic<bool> ending_ = false;
  std::atomic<std::size_t> busy_ = 0;
  const std::function<void(std::size_t)>* task_ = nullptr;  // while others may join
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::exception_ptr failure_;  // thrown by a task of this round
};

// Sizes of tasks worth giving to another thread: nodes or faces to compute something for, and nodes only to be copied.
inline constexpr std::size_t nodes_per_task = 2048;
inline constexpr std::size_t faces_per_task = 4096;
inline constexpr std::size_t light_nodes_per_task = 16384;

/// Calls body(begin, end) for ranges that together cover 0 … count − 1, each at most `grain` long. The ranges do not
/// depend on the size of the team.
template <typename Body>
void parallel_ranges(ThreadTeam& team, std::size_t count, std::size_t grain, const Body& body) {
  const std::size_t ranges = (count + grain - 1) / grain;
  team.run(ranges, [&](std::size_t k) { body(k * grain, k + 1 == ranges ? count : (k + 1) * grain); });
}

/// Calls body(i) for i from 0 to count − 1, in the ranges of parallel_ranges().
template <typename Body>
void parallel_each(ThreadTeam& team, std::size_t count, std::size_t grain, const Body& body) {
  parallel_ranges(team, count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// As parallel_ranges(), but each range has its own part of the result: body(begin, end, part). Returns the parts in
/// order, so results combined from them have the same bits for every size of team.
template <typename Part, typename Body>
std::vector<Part> parallel_parts(ThreadTeam& team, std::size_t count, std::size_t grain, const Part& initial,
                                 const Body& body) {
  std::vector<Part> parts((count + grain - 1) / grain, initial);
  parallel_ranges(team, count, grain,
                  [&](std::size_t begin, std::size_t end) { body(begin, end, parts[begin / grain]); });
  return parts;
}

}  // namespace vspring
