#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "vspring/surface_file.hpp"

namespace vspring::cli {

/// Adds an option whose values are words. `target` and `choices` must outlive the command.
template <typename Value, typename Target>
CLI::Option* add_choice(CLI::App& command, const std::string& flag, Target& target,
                        const std::map<std::string, Value>& choices, const std::string& help) {
  std::string words;
  for (const auto& [word, value] : choices) words += (words.empty() ? "" : "|") + word;
  return command
      .add_option_function<std::string>(
          flag,
          [&target, &choices, flag, words](const std::string& word) {
            const auto choice = choices.find(word);
            if (choice == choices.end()) throw CLI::ValidationError(flag, "\"" + word + "\" is not one of " + words);
            target = choice->second;
          },
          help)
      ->type_name(words);
}

/// Values of --format.
inline const std::map<std::string, SurfaceFormat> surface_formats = {
    {"obj", SurfaceFormat::obj}, {"off", SurfaceFormat::off}, {"ply", SurfaceFormat::ply}, {"stl", SurfaceFormat::stl}};

}  // namespace vspring::cli
