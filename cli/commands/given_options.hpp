#pragma once

#include <CLI/CLI.hpp>
#include <set>
#include <string>

namespace vspring::cli {

/// Options that were given, by their long names; once a command is parsed.
inline std::set<std::string> given_options(const CLI::App& command) {
  std::set<std::string> given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0) given.insert(option->get_name());
  }
  return given;
}

}  // namespace vspring::cli
