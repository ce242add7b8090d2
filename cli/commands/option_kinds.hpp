#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <type_traits>

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

/// Ranges of numeric options; they are refused in words, while CLI11's validators print the largest number.
inline CLI::Validator positive_number() {
  return {[](const std::string& given) -> std::string {
            double number = 0;
            if (CLI::detail::lexical_cast(given, number) && number > 0 && std::isfinite(number)) return {};
            return "a number greater than 0 is needed, not " + given;
          },
          "POSITIVE"};
}

inline CLI::Validator non_negative_number() {
  return {[](const std::string& given) -> std::string {
            double number = 0;
            if (CLI::detail::lexical_cast(given, number) && number >= 0 && std::isfinite(number)) return {};
            return "a number of 0 or more is needed, not " + given;
          },
          "NONNEGATIVE"};
}

/// Degrees, between 0 and 180.
inline CLI::Validator angle_of_corners() {
  return {[](const std::string& given) -> std::string {
            double number = 0;
            if (CLI::detail::lexical_cast(given, number) && number > 0 && number < 180) return {};
            return "a number of more than 0 and less than 180 is needed, not " + given;
          },
          "0 to 180"};
}

inline CLI::Validator number_between(double least, double most) {
  return {[least, most](const std::string& given) -> std::string {
            double number = 0;
            if (CLI::detail::lexical_cast(given, number) && number >= least && number <= most) return {};
            return fmt::format("a number from {} to {} is needed, not {}", least, most, given);
          },
          fmt::format("{} to {}", least, most)};
}

inline CLI::Validator whole_number(int least, int most = std::numeric_limits<int>::max()) {
  return {[least, most](const std::string& given) -> std::string {
            int number = 0;
            if (CLI::detail::lexical_cast(given, number) && number >= least && number <= most) return {};
            return fmt::format("a whole number from {} to {} is needed, not {}", least, most, given);
          },
          most < std::numeric_limits<int>::max() ? fmt::format("{} to {}", least, most) : "WHOLE"};
}

/// Checks the type; further conditions are checked elsewhere.
template <typename Number>
CLI::Validator any_number() {
  return {[](const std::string& given) -> std::string {
            Number number = 0;
            // For unsigned types CLI11 takes -1 for the largest number.
            const bool may_be = std::is_signed_v<Number> || !given.starts_with('-');
            if (may_be && CLI::detail::lexical_cast(given, number) && std::isfinite(static_cast<double>(number)))
              return {};
            return fmt::format("a {} is needed, not {}",
                               std::is_floating_point_v<Number> ? "number"
                               : std::is_signed_v<Number>       ? "whole number"
                                                                : "whole number of 0 or more",
                               given);
          },
          ""};
}

/// The given options, by their long names, of a parsed command.
inline std::set<std::string> given_options(const CLI::App& command) {
  std::set<std::string> given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0) given.insert(option->get_name());
  }
  return given;
}

/// Runs a command that fairs or measures, with the given options. `run` must outlive it.
template <typename Arguments>
void when_given(CLI::App& command, const std::shared_ptr<Arguments>& arguments, std::function<int()>& run,
                int (*run_command)(Arguments)) {
  command.callback([arguments, &run, &command, run_command] {
    arguments->given = given_options(command);
    run = [arguments, run_command] { return run_command(*arguments); };
  });
}

}  // namespace vspring::cli
