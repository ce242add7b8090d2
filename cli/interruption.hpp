#pragma once

#include <condition_variable>
#include <csignal>
#include <mutex>
#include <optional>
#include <thread>

#include "vspring/context.hpp"
#include "vspring/fair.hpp"

namespace vspring::cli {

/// While it lives, Ctrl-C and SIGTERM cancel the context, so that the best shape so far can be written; a second one
/// ends the program at once.
class CancelOnSignal {
 public:
  enum class While { reading, working };

  /// While the input is read there is nothing to write, and the first one ends the program at once, too, with the exit
  /// status of an interrupted run: until input_is_read().
  explicit CancelOnSignal(Context& context, While now = While::working);
  ~CancelOnSignal();
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;

  void input_is_read() noexcept;
};

/// Whether Ctrl-C or SIGTERM has come while one of these lived.
[[nodiscard]] bool was_interrupted() noexcept;

/// While it lives, Ctrl-C and SIGTERM wait: a file that is being written is finished first.
class UninterruptedWhileWriting {
 public:
  UninterruptedWhileWriting();
  ~UninterruptedWhileWriting();
  UninterruptedWhileWriting(const UninterruptedWhileWriting&) = delete;
  UninterruptedWhileWriting& operator=(const UninterruptedWhileWriting&) = delete;

 private:
  sigset_t before_;
};

/// While it lives, Ctrl-C, SIGTERM and SIGHUP reach nobody but wait().
class AwaitedSignals {
 public:
  AwaitedSignals();
  ~AwaitedSignals();
  AwaitedSignals(const AwaitedSignals&) = delete;
  AwaitedSignals& operator=(const AwaitedSignals&) = delete;

  void wait() const;

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

/// Cancels a context after so many seconds, from when it is made until it ends.
class TimeLimit {
 public:
  TimeLimit(Context& context, std::optional<double> seconds);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  /// From here on time is no matter. A run that the limit, and not Ctrl-C, has cancelled becomes one that has reached
  /// its limit of work, with a warning, and its context usable again.
  void end(FairReport& report);

 private:
  void stop();

  Context* context_;
  std::optional<double> seconds_;
  std::mutex mutex_;
  std::condition_variable stopping_;
  bool stopped_ = false;
  bool reached_ = false;
  std::thread timer_;
};

}  // namespace vspring::cli
