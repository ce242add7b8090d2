#include "base/threads.hpp"

#include <algorithm>

#include "vspring/context.hpp"

namespace vspring {

namespace {

// Waking a thread takes longer than many a loop over some thousand nodes; a yield takes a fraction of a microsecond.
constexpr int looks_before_sleep = 100;

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
    busy_ = workers_.size();
    ++round_;
  }
  started_.notify_all();
  take_tasks();
  wait(finished_, [this] { return busy_ == 0; });
}

template <typename Holds>
void ThreadTeam::wait(std::condition_variable& signal, const Holds& holds) {
  for (int look = 0; look < looks_before_sleep; ++look) {
    if (holds()) return;
    std::this_thread::yield();
  }
  std::unique_lock lock(mutex_);
  signal.wait(lock, holds);
}

void ThreadTeam::take_tasks() {
  for (;;) {
    const std::size_t k = next_.fetch_add(1, std::memory_order_relaxed);
    if (k >= count_) return;
    (*task_)(k);
  }
}

void ThreadTeam::work() {
  std::uint64_t seen = 0;
  for (;;) {
    wait(started_, [&] { return ending_ || round_ != seen; });
    if (ending_) return;
    seen = round_;
    take_tasks();
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) finished_.notify_one();
  }
}

}  // namespace vspring
