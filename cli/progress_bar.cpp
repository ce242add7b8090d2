#include "progress_bar.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace vspring::cli {

namespace {

// A bar that flashes up for less is a nuisance.
constexpr double shortest_shown = 0.3;
constexpr int width = 24;

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace

void ProgressBar::show(const Progress& progress) {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (!terminal_->interactive() || elapsed < shortest_shown) return;
  const int filled = static_cast<int>(progress.fraction * width);
  std::string line = "\r\x1b[K";
  line += progress.stage;
  line += " [" + std::string(static_cast<std::size_t>(filled), '#') +
          std::string(static_cast<std::size_t>(width - filled), '.') + "]";
  line += fmt::format(" {:3.0f} %", 100 * progress.fraction);
  if (progress.iteration > 0) line += fmt::format("  iteration {}, step {:.1e}", progress.iteration, progress.residual);
  line += "  " + duration(elapsed);
  if (progress.fraction > 0.02) line += ", " + duration(elapsed / progress.fraction - elapsed) + " left";
  shown_ = terminal_->write(line) || shown_;
}

void ProgressBar::clear() {
  if (shown_) (void)terminal_->write("\r\x1b[K");
  shown_ = false;
  begin_ = std::chrono::steady_clock::now();
}

}  // namespace vspring::cli
