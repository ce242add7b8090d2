#pragma once

#include <initializer_list>
#include <optional>
#include <string>

namespace vspring::cli {

/// The first of these programs that PATH has, with its folder. Empty where it has none.
[[nodiscard]] std::optional<std::string> find_program(std::initializer_list<const char*> names);

}  // namespace vspring::cli
