#include "base/cancellation.hpp"

namespace vspring {

namespace {

thread_local const Context* watched_context = nullptr;

}  // namespace

CancellationScope::CancellationScope(const Context& context) noexcept : own_(&context), around_(watched_context) {
  watched_context = &context;
}

CancellationScope::~CancellationScope() {
  const bool has_thrown = watched_context == nullptr;
  watched_context = has_thrown && around_ == own_ ? nullptr : around_;
}

UncancelledScope::UncancelledScope() noexcept : around_(watched_context) { watched_context = nullptr; }

UncancelledScope::~UncancelledScope() { watched_context = around_; }

void end_if_cancelled() {
  if (watched_context == nullptr || !watched_context->cancelled()) return;
  watched_context = nullptr;
  throw Cancelled();
}

}  // namespace vspring
