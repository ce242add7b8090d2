#pragma once

#include "vspring/fair.hpp"

namespace vspring::cli {

// Exit statuses are promised to scripts.
inline constexpr int exit_converged = 0;
inline constexpr int exit_wrong_use = 1;
inline constexpr int exit_unusable = 2;
inline constexpr int exit_not_converged = 3;
inline constexpr int exit_interrupted = 130;

[[nodiscard]] inline int exit_status(const FairReport& report) noexcept {
  if (report.usable()) return exit_converged;
  return report.outcome == Outcome::cancelled ? exit_interrupted : exit_not_converged;
}

}  // namespace vspring::cli
