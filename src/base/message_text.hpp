#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vspring {

/// Bytes of a file for a message: in quotes, at most 24 of them, what is not printable ASCII as "?".
std::string in_quotes(std::string_view bytes);

/// UTF-8 that a user wrote, for a message: in one line, at most some `longest` bytes, control characters as "?".
std::string in_one_line(std::string_view text, std::size_t longest = 100);

}  // namespace vspring
