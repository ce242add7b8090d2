#include "base/threads.hpp"

#include <algorithm>

#include "vspring/context.hpp"

namespace vspring {

namespace {

// Some 30 microseconds: waking a thread takes longer than many a loop over some thousand nodes.
constexpr int looks_before_sleep = 2000;

/// Not a yield: that would hand the core to other programs for milliseconds.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

int Context::thread_count() const noexcept {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ThreadTeam::ThreadTeam(int threads) {
  for (int k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  started_.notify_all();
  for (auto& worker : workers_) worker.join();
}

void ThreadTeam::run(std::size_t count, const std::function<void(std::size_t)>& task) {
  if (workers_.empty() || count < 2) {
    for (std::size_t k = 0; k < count; ++k) task(k);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    task_ = &task;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    ++round_;
  }
  started_.notify_all();
  take_tasks(task, count);
  {
    // Whoever has not come by now is not waited for: another program may have its core.
    const std::lock_guard lock(mutex_);
    task_ = nullptr;
  }
  wait(finished_, [this] { return busy_ == 0; });
}

template <typename Holds>
void ThreadTeam::wait(std::condition_variable& signal, const Holds& holds) {
  for (int look = 0; look < looks_before_sleep; ++look) {
    if (holds()) return;
    pause();
  }
  std::unique_lock lock(mutex_);
  signal.wait(lock, holds);
}

void ThreadTeam::take_tasks(const std::function<void(std::size_t)>& task, std::size_t count) {
  for (;;) {
    const std::size_t k = next_.fetch_add(1, std::memory_order_relaxed);
    if (k >= count) return;
    task(k);
  }
}

void ThreadTeam::work() {
  std::uint64_t seen = 0;
  for (;;) {
    wait(started_, [&] { return ending_ || round_ != seen; });
    if (ending_) return;
    const std::function<void(std::size_t)>* task = nullptr;
    std::size_t count = 0;
    {
      const std::lock_guard lock(mutex_);
      seen = round_;
      if (task_ == nullptr) continue;
      ++busy_;
      task = task_;
      count = count_;
    }
    take_tasks(*task, count);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) finished_.notify_one();
  }
}

}  // namespace vspring
