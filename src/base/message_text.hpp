#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "vspring/types.hpp"

namespace vspring {

/// Quotes bytes of a file in a message: at most 24, with "?" for all but printable ASCII.
std::string in_quotes(std::string_view bytes);

/// Puts a user's UTF-8 text into a message: on one line, about `longest` bytes at most, with "?" for control
/// characters.
std::string in_one_line(std::string_view text, std::size_t longest = 100);

/// "node 3", "nodes 3, 5, 8" or, of more than five, "nodes 3, 5, 8, 9, 12 and 4 more".
std::string nodes_in_words(std::span<const Index> nodes);

}  // namespace vspring
