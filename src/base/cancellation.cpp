#include "base/cancellation.hpp"

#ifdef __EMSCRIPTEN__
#include <pthread.h>
#endif

namespace vspring {

namespace {

#ifdef __EMSCRIPTEN__

// One build serves programs with threads and without; in those without, thread_local variables may share their place
// with other data.
pthread_key_t watched_key() {
  static const pthread_key_t key = [] {
    pthread_key_t made{};
    (void)pthread_key_create(&made, nullptr);
    return made;
  }();
  return key;
}

const Context* watched() { return static_cast<const Context*>(pthread_getspecific(watched_key())); }
void watch(const Context* context) { (void)pthread_setspecific(watched_key(), context); }

#else

thread_local const Context* watched_context = nullptr;

const Context* watched() { return watched_context; }
void watch(const Context* context) { watched_context = context; }

#endif

}  // namespace

CancellationScope::CancellationScope(const Context& context) noexcept : own_(&context), around_(watched()) {
  watch(&context);
}

CancellationScope::~CancellationScope() {
  const bool has_thrown = watched() == nullptr;
  watch(has_thrown && around_ == own_ ? nullptr : around_);
}

UncancelledScope::UncancelledScope() noexcept : around_(watched()) { watch(nullptr); }

UncancelledScope::~UncancelledScope() { watch(around_); }

void end_if_cancelled() {
  const Context* const context = watched();
  if (context == nullptr || !context->cancelled()) return;
  watch(nullptr);
  throw Cancelled();
}

}  // namespace vspring
