#pragma once

#include <cstddef>

#include "vspring/context.hpp"

namespace vspring {

/// Thrown out of work whose context has been cancelled, wherever that is noticed.
struct Cancelled {};

/// While it lives, end_if_cancelled() on this thread looks at that context, and at none that a scope around it names.
/// It throws once: whoever catches that and clears up is not disturbed again by the same context, in scopes around
/// this one neither.
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
/// what others have given to be called.
class UncancelledScope {
 public:
  UncancelledScope() noexcept;
  ~UncancelledScope();
  UncancelledScope(const UncancelledScope&) = delete;
  UncancelledScope& operator=(const UncancelledScope&) = delete;

 private:
  const Context* around_;
};

/// Throws Cancelled where this thread is in the scope of a context that has been cancelled. Every long loop calls it,
/// and teams of threads do before each task.
void end_if_cancelled();

/// The same at every 4,096th step of a loop of small steps.
inline void end_if_cancelled_at(std::size_t step) {
  constexpr std::size_t steps = 4096;
  if (step % steps == 0) end_if_cancelled();
}

}  // namespace vspring
