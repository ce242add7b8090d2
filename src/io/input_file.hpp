#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vspring/advice.hpp"

namespace vspring {

/// The bytes of a file, and its name for messages.
struct InputFile {
  std::string name;
  std::string bytes;

  /// 1 for the first line.
  [[nodiscard]] std::size_t line_of(std::size_t offset) const;
  /// Throws Error(unusable_file): "NAME: FAULT".
  [[noreturn]] void refuse(std::string_view fault, std::vector<Advice> advice = {}) const;
  /// Throws Error(unusable_file): "NAME:LINE: FAULT".
  [[noreturn]] void refuse_line(std::size_t offset, std::string_view fault, std::vector<Advice> advice = {}) const;
};

/// A file of that name with these bytes. Throws Error(unusable_file) if there are none.
InputFile input_of(std::string bytes, const std::string& name);

/// Reads a file, or standard input for "-". Throws Error(unusable_file) if it cannot be read or is empty.
InputFile read_input(const std::string& path);

/// Throws Error(unusable_file) if a file that should be text is in UTF-16.
void require_utf8(const InputFile& file);

}  // namespace vspring
