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

  /// Until input_is_read() there is nothing to write: then already the first one ends the program at once, with the
  /// exit status of an interrupted run.
  explicit CancelOnSignal(Context& context, While now = While::working);
  ~CancelOnSignal();
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;

  void input_is_read() noexcept;
};

/// Whether Ctrl-C or SIGTERM came while a CancelOnSignal lived.
[[nodiscard]] bool was_interrupted() noexcept;

/// While it lives, Ctrl-C and SIGTERM are delayed, so that a file being written is finished first.
class UninterruptedWhileWriting {
 public:
  UninterruptedWhileWriting();
  ~UninterruptedWhileWriting();
  UninterruptedWhileWriting(const UninterruptedWhileWriting&) = delete;
  UninterruptedWhileWriting& operator=(const UninterruptedWhileWriting&) = delete;

 private:
  sigset_t before_;
};

/// While it lives, Ctrl-C, SIGTERM and SIGHUP only reach wait().
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

  /// Ends the limit. If it, and not Ctrl-C, has cancelled the run, the outcome becomes work_limit, with a warning, and
  /// the context is usable again.
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
