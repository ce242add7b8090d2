#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// How far a long call has come.
struct Progress {
  std::string_view stage;  ///< what is being done, in a word or two; static storage
  double fraction = 0;     ///< of the whole call, 0 to 1, never falling
  int iteration = 0;       ///< iterations done so far; 0 outside iterations
  double residual = 0;     ///< the figure that the stopping test compares; 0 outside iterations
};

/// Progress, cancellation and threads of calls. Every long loop of the library asks its context. One context may serve
/// several calls in turn, but not at the same time.
class Context {
 public:
  /// Called by the thread that made the call, at most about 20 times a second. May call cancel().
  std::function<void(const Progress&)> on_progress;

  /// Threads to use; 0: all cores. Results have the same bits for every number of threads.
  int threads = 0;

  /// Asks the running call to end soon with the best shape so far. Safe from other threads and from signal handlers.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  /// Whether cancel() was called, and reset() not since.
  [[nodiscard]] bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }
  /// Makes the context usable again after cancel().
  void reset() noexcept { cancelled_.store(false, std::memory_order_relaxed); }

  /// `threads`, or the number of cores if that is 0; at least 1.
  [[nodiscard]] int thread_count() const noexcept;

 private:
  std::atomic<bool> cancelled_ = false;
  static_assert(std::atomic<bool>::is_always_lock_free, "cancel() must be safe in signal handlers");
};

}  // namespace vspring
