#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "vspring/context.hpp"
#include "vspring/fair.hpp"

namespace vspring::cli {

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
