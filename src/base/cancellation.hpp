#pragma once

#include <cstddef>

#include "vspring/context.hpp"

namespace vspring {

/// Thrown by end_if_cancelled().
struct Cancelled {};

/// While it lives, end_if_cancelled() on this thread watches this context instead of those of enclosing scopes. A
/// context makes it throw once only, so that the cleanup after that is not interrupted, also in enclosing scopes.
class CancellationScope {
 public:
  explicit CancellationScope(const Context& context) noexcept;
  ~CancellationScope();
  CancellationScope(const CancellationScope&) = delete;
  CancellationScope& operator=(const CancellationScope&) = delete;

 private:
  const Context* own_;
  const Context* around_;
};

/// While it lives, end_if_cancelled() on this thread does nothing: for work that must not be left half done, and for
/// callbacks.
class UncancelledScope {
 public:
  UncancelledScope() noexcept;
  ~UncancelledScope();
  UncancelledScope(const UncancelledScope&) = delete;
  UncancelledScope& operator=(const UncancelledScope&) = delete;

 private:
  const Context* around_;
};

/// Throws Cancelled if this thread is in the scope of a cancelled context. Every long loop calls it; teams of threads
/// call it before each task.
void end_if_cancelled();

/// Calls end_if_cancelled() at every 4,096th step: for loops of small steps.
inline void end_if_cancelled_at(std::size_t step) {
  constexpr std::size_t steps = 4096;
  if (step % steps == 0) end_if_cancelled();
}

}  // namespace vspring
