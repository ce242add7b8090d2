#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

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

}  // namespace vspring::cli
