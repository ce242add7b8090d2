#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>

#include "base/cancellation.hpp"
#include "vspring/context.hpp"

namespace vspring {

/// Reports the progress of a call to its context: when a stage begins, and at most about 20 times a second. It never
/// falls.
class ProgressReporter {
 public:
  explicit ProgressReporter(const Context& context) : context_(&context) {}

  void report(std::string_view stage, double fraction, int iteration = 0, double residual = 0) {
    if (!context_->on_progress) return;
    fraction_ = std::max(fraction_, begin_ + (1 - begin_) * std::clamp(fraction, 0.0, 1.0));
    const auto now = std::chrono::steady_clock::now();
    if (stage == stage_ && now - last_ < std::chrono::milliseconds(50)) return;
    stage_ = stage;
    last_ = now;
    const UncancelledScope of_others;
    context_->on_progress({stage, fraction_, iteration, residual});
  }

  /// Work begins anew, as the first result was none: what follows is a share of what is left.
  void begin_anew() { begin_ = fraction_; }

 private:
  const Context* context_;
  double fraction_ = 0;
  double begin_ = 0;
  std::string stage_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace vspring
