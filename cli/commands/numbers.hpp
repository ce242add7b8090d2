#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace vspring::cli {

/// What options for numbers may be; refused in words, where those of CLI11 print the largest number there is.
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

}  // namespace vspring::cli
