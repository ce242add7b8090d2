#pragma once

#include <string>
#include <string_view>

namespace vspring {

/// A file read whole, and the name it goes by in messages.
struct InputFile {
  std::string name;
  std::string bytes;

  /// 1 for the first line.
  [[nodiscard]] std::size_t line_of(std::size_t offset) const;
  /// Throws Error(unusable_file): "NAME: WHAT".
  [[noreturn]] void refuse(std::string_view what) const;
  /// Throws Error(unusable_file): "NAME:LINE: WHAT".
  [[noreturn]] void refuse_line(std::size_t offset, std::string_view what) const;
};

/// Bytes in memory as a file of that name. Throws Error(unusable_file) where there are none.
InputFile input_of(std::string bytes, const std::string& name);

/// Reads a file, or standard input for "-". Throws Error(unusable_file) for what cannot be read, and for nothing in it.
InputFile read_input(const std::string& path);

}  // namespace vspring
