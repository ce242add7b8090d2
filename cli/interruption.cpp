#include "interruption.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>

#include "exit_status.hpp"

namespace vspring::cli {

namespace {

std::atomic<Context*> cancelled_by_signal = nullptr;
std::atomic<bool> interrupted = false;
std::atomic<bool> nothing_to_write = false;
static_assert(std::atomic<Context*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void cancel(int signal) {
  if (nothing_to_write.load()) ::_exit(exit_interrupted);
  interrupted.store(true);
  if (Context* context = cancelled_by_signal.load()) context->cancel();
  std::signal(signal, SIG_DFL);
}

}  // namespace

CancelOnSignal::CancelOnSignal(Context& context, While now) {
  nothing_to_write.store(now == While::reading);
  cancelled_by_signal.store(&context);
  std::signal(SIGINT, cancel);
  std::signal(SIGTERM, cancel);
}

CancelOnSignal::~CancelOnSignal() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  nothing_to_write.store(false);
  cancelled_by_signal.store(nullptr);
}

void CancelOnSignal::input_is_read() noexcept { nothing_to_write.store(false); }

bool was_interrupted() noexcept { return interrupted.load(); }

UninterruptedWhileWriting::UninterruptedWhileWriting() {
  sigset_t waiting;
  sigemptyset(&waiting);
  sigaddset(&waiting, SIGINT);
  sigaddset(&waiting, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &waiting, &before_);
}

UninterruptedWhileWriting::~UninterruptedWhileWriting() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

AwaitedSignals::AwaitedSignals() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
}

AwaitedSignals::~AwaitedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

void AwaitedSignals::wait() const {
  int signal = 0;
  sigwait(&signals_, &signal);
}

TimeLimit::TimeLimit(Context& context, std::optional<double> seconds) : context_(&context), seconds_(seconds) {
  if (!seconds) return;
  // Limits beyond the range of clocks are none.
  constexpr double longest = 1e9;
  if (*seconds > longest) return;
  timer_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    if (stopping_.wait_for(lock, std::chrono::duration<double>(*seconds_), [this] { return stopped_; })) return;
    reached_ = true;
    context_->cancel();
  });
}

TimeLimit::~TimeLimit() { stop(); }

void TimeLimit::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  stopping_.notify_all();
  if (timer_.joinable()) timer_.join();
}

void TimeLimit::end(FairReport& report) {
  stop();
  if (!reached_) return;
  // Otherwise a signal between test and reset would be lost.
  const UninterruptedWhileWriting guard;
  if (was_interrupted()) return;
  context_->reset();
  if (report.outcome != Outcome::cancelled) return;
  report.outcome = Outcome::work_limit;
  report.warnings.push_back(
      {WarningCode::time_limit,
       fmt::format("the time limit of {} s has ended it: this is the best shape so far", *seconds_),
       {{Remedy::time, "allow more time"}, {Remedy::region, "let a smaller part move"}}});
}

}  // namespace vspring::cli
