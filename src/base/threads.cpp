#include "base/threads.hpp"

#if (defined(__unix__) || defined(__APPLE__)) && !defined(__EMSCRIPTEN__)
#include <pthread.h>
#endif

#include <algorithm>
#include <exception>
#include <new>
#include <thread>
#include <typeinfo>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "vspring/context.hpp"

namespace vspring {

namespace {

// About 30 microseconds: waking a thread may take longer than a loop over some thousand nodes.
#if defined(__x86_64__)
constexpr int looks_before_sleep = 2000;
#else
constexpr int looks_before_sleep = 16000;  // without pauses
#endif

void (*watcher)(const std::type_info& work) = nullptr;

/// Not a yield, which would give the core to other programs for milliseconds.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Spins until the condition holds, for as long as a pause between two loops lasts.
template <typename Holds>
bool soon(const Holds& holds) {
  for (int look = 0; look < looks_before_sleep; ++look) {
    if (holds()) return true;
    pause();
  }
  return holds();
}

}  // namespace

int Context::thread_count() const noexcept {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// The threads that help teams. One is started when a team calls and none is idle; between teams they sleep. Threads
/// and pool are never ended, so the program need not wait for them when it ends.
class WorkerPool {
 public:
  static WorkerPool& of_program() {
    static std::atomic<WorkerPool*>& helpers = made();
    return *helpers.load(std::memory_order_relaxed);
  }

  /// Returns how many threads were called: none if memory runs out.
  int call(ThreadTeam& team, int count) noexcept {
    calls_so_far_.fetch_add(1, std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    try {
      calls_.insert(calls_.end(), count, &team);
    } catch (const std::bad_alloc&) {
      return 0;
    }
    try {
      for (; idle_ < calls_.size(); ++idle_) std::thread([this] { live(); }).detach();
    } catch (const std::exception&) {
      // No thread can be started: the next idle one will answer.
    }
    for (int k = 0; k < count; ++k) called_.notify_one();
    return count;
  }

  [[nodiscard]] std::size_t calls_so_far() const noexcept { return calls_so_far_.load(std::memory_order_relaxed); }

  /// Withdraws the team's unanswered calls and returns their number.
  int withdraw(const ThreadTeam& team) {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(std::erase(calls_, &team));
  }

 private:
  /// A forked process has none of the threads, but would wait for them: it gets a pool of its own.
  static std::atomic<WorkerPool*>& made() {
    static std::atomic<WorkerPool*> helpers = new WorkerPool;
#if (defined(__unix__) || defined(__APPLE__)) && !defined(__EMSCRIPTEN__)
    ::pthread_atfork(nullptr, nullptr, [] { helpers.store(new WorkerPool, std::memory_order_relaxed); });
#endif
    return helpers;
  }

  [[noreturn]] void live() {
    std::unique_lock lock(mutex_);
    for (;;) {
      called_.wait(lock, [this] { return !calls_.empty(); });
      ThreadTeam& team = *calls_.back();
      calls_.pop_back();
      --idle_;
      lock.unlock();
      team.help();
      lock.lock();
      ++idle_;
    }
  }

  std::mutex mutex_;
  std::condition_variable called_;
  std::vector<ThreadTeam*> calls_;
  std::size_t idle_ = 0;
  std::atomic<std::size_t> calls_so_far_ = 0;
};

void ThreadTeam::watch(void (*see)(const std::type_info& work)) noexcept { watcher = see; }

std::size_t ThreadTeam::calls_for_help() noexcept { return WorkerPool::of_program().calls_so_far(); }

ThreadTeam::~ThreadTeam() {
  if (round_ == 0) return;
  ending_ = true;
  const int unanswered = WorkerPool::of_program().withdraw(*this);
  std::unique_lock lock(mutex_);
  helpers_ -= unanswered;
  finished_.wait(lock, [this] { return helpers_ == 0; });
}

void ThreadTeam::run(std::size_t count, const std::function<void(std::size_t)>& task) {
  if (size_ < 2 || count < 2) {
    for (std::size_t k = 0; k < count; ++k) {
      end_if_cancelled();
      task(k);
    }
    return;
  }
  if (watcher != nullptr) watcher(task.target_type());
  int missing = 0;
  {
    const std::lock_guard lock(mutex_);
    task_ = &task;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    ++round_;
    missing = size_ - 1 - helpers_;
    helpers_ += missing;
  }
  if (missing > 0) {
    const int called = WorkerPool::of_program().call(*this, missing);
    const std::lock_guard lock(mutex_);
    helpers_ -= missing - called;
  }
  take_tasks(task, count);
  {
    // Threads that have not answered by now are not waited for: another program may have their core.
    const std::lock_guard lock(mutex_);
    task_ = nullptr;
  }
  const auto done = [this] { return busy_ == 0; };
  if (!soon(done)) {
    std::unique_lock lock(mutex_);
    finished_.wait(lock, done);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadTeam::take_tasks(const std::function<void(std::size_t)>& task, std::size_t count) {
  for (;;) {
    const std::size_t k = next_.fetch_add(1, std::memory_order_relaxed);
    if (k >= count) return;
    try {
      end_if_cancelled();
      task(k);
    } catch (...) {
      // Other threads are still at work, and the data that they read must stay until they are done.
      next_.store(count, std::memory_order_relaxed);
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }
}

void ThreadTeam::help() {
  std::uint64_t seen = 0;
  for (;;) {
    (void)soon([&] { return ending_ || round_ != seen; });
    const std::function<void(std::size_t)>* task = nullptr;
    std::size_t count = 0;
    {
      const std::lock_guard lock(mutex_);
      if (ending_ || round_ == seen) {
        // The last helper is done: the team may end.
        if (--helpers_ == 0) finished_.notify_one();
        return;
      }
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
