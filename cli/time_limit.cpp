#include "time_limit.hpp"

#include <fmt/format.h>

#include <chrono>

#include "signals.hpp"

namespace vspring::cli {

TimeLimit::TimeLimit(Context& context, std::optional<double> seconds) : context_(&context), seconds_(seconds) {
  if (!seconds) return;
  // Longer ones than clocks can tell are none.
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
  // A signal between the question and the answer would be lost.
  const UninterruptedWhileWriting guard;
  if (was_interrupted()) return;
  context_->reset();
  if (report.outcome != Outcome::cancelled) return;
  report.outcome = Outcome::work_limit;
  report.warnings.push_back(
      {WarningCode::time_limit,
       fmt::format("the time limit of {} s has ended it: this is the best shape so far; allow more time, or let a "
                   "smaller part move",
                   *seconds_)});
}

}  // namespace vspring::cli
