#pragma once

#include <csignal>

#include "vspring/context.hpp"

namespace vspring::cli {

/// While it lives, Ctrl-C and SIGTERM cancel the context, so that the best shape so far can be written; a second one
/// ends the program at once.
class CancelOnSignal {
 public:
  explicit CancelOnSignal(Context& context);
  ~CancelOnSignal();
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;
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

}  // namespace vspring::cli
