#pragma once

#include <chrono>

#include "terminal.hpp"
#include "vspring/context.hpp"

namespace vspring::cli {

/// A line on a terminal that shows how far a call has come and how long it will take; nothing for short calls and
/// elsewhere.
class ProgressBar {
 public:
  explicit ProgressBar(const Terminal& terminal) : terminal_(&terminal) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Takes the line away; what is shown next is another call.
  void clear();

 private:
  const Terminal* terminal_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool shown_ = false;
};

}  // namespace vspring::cli
