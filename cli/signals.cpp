#include "signals.hpp"

#include <atomic>
#include <csignal>

namespace vspring::cli {

namespace {

std::atomic<Context*> cancelled_by_signal = nullptr;
std::atomic<bool> interrupted = false;
static_assert(std::atomic<Context*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void cancel(int signal) {
  interrupted.store(true);
  if (Context* context = cancelled_by_signal.load()) context->cancel();
  std::signal(signal, SIG_DFL);
}

}  // namespace

CancelOnSignal::CancelOnSignal(Context& context) {
  cancelled_by_signal.store(&context);
  std::signal(SIGINT, cancel);
  std::signal(SIGTERM, cancel);
}

CancelOnSignal::~CancelOnSignal() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  cancelled_by_signal.store(nullptr);
}

bool was_interrupted() noexcept { return interrupted.load(); }

UninterruptedWhileWriting::UninterruptedWhileWriting() {
  sigset_t waiting;
  sigemptyset(&waiting);
  sigaddset(&waiting, SIGINT);
  sigaddset(&waiting, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &waiting, &before_);
}

UninterruptedWhileWriting::~UninterruptedWhileWriting() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace vspring::cli
