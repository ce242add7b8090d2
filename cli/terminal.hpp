#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/context.hpp"

namespace vspring::cli {

enum class Colour { automatic, always, never };

/// A standard stream, with or without colours.
class Terminal {
 public:
  /// descriptor: 1 for standard output, 2 for standard error. Automatic: coloured if it is a terminal, NO_COLOR is
  /// empty or unset (https://no-color.org) and TERM is not "dumb".
  Terminal(int descriptor, Colour colour);

  [[nodiscard]] bool interactive() const noexcept { return interactive_; }
  [[nodiscard]] std::string bold(std::string_view text) const { return styled("1", text); }
  [[nodiscard]] std::string green(std::string_view text) const { return styled("32", text); }
  [[nodiscard]] std::string yellow(std::string_view text) const { return styled("33", text); }
  [[nodiscard]] std::string red(std::string_view text) const { return styled("31", text); }

  /// Writes all of the text; false if the stream takes no more.
  [[nodiscard]] bool write(std::string_view text) const;

  /// Writes a line for each.
  void warn(const std::vector<std::string>& warnings) const;

 private:
  [[nodiscard]] std::string styled(const char* code, std::string_view text) const;

  int descriptor_;
  bool interactive_;
  bool coloured_;
};

// The name of a file in messages.
[[nodiscard]] inline std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }
[[nodiscard]] inline std::string output_name(const std::string& path) { return path == "-" ? "standard output" : path; }

/// A line on a terminal that shows the progress of a call and the time left; nothing for short calls and other streams.
class ProgressBar {
 public:
  explicit ProgressBar(const Terminal& terminal) : terminal_(&terminal) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Removes the line; the next progress is that of another call.
  void clear();

 private:
  const Terminal* terminal_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool shown_ = false;
};

}  // namespace vspring::cli
