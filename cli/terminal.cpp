#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

namespace vspring::cli {

namespace {

bool environment_allows_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  if (no_colour != nullptr && *no_colour != '\0') return false;
  const char* terminal = std::getenv("TERM");
  return terminal == nullptr || std::strcmp(terminal, "dumb") != 0;
}

}  // namespace

Terminal::Terminal(int descriptor, Colour colour)
    : descriptor_(descriptor),
      interactive_(isatty(descriptor) == 1),
      coloured_(colour == Colour::always ||
                (colour == Colour::automatic && interactive_ && environment_allows_colour())) {}

std::string Terminal::styled(const char* code, std::string_view text) const {
  return coloured_ ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
}

void Terminal::warn(const std::vector<std::string>& warnings) const {
  for (const std::string& warning : warnings) (void)write(yellow("warning: ") + warning + "\n");
}

bool Terminal::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

namespace {

// A bar that appears for less is a nuisance.
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
