#include "symmetry/given_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <system_error>

#include "vspring/warning.hpp"

namespace vspring {

namespace {

/// A word before numbers, and which numbers these are.
struct Numbered {
  std::string_view word;
  Index (GivenNumbers::*given)(Index) const;
};

constexpr std::array<Numbered, 4> numbered = {{{"node", &GivenNumbers::node},
                                               {"edge", &GivenNumbers::node},
                                               {"face", &GivenNumbers::face},
                                               {"point", &GivenNumbers::point}}};
// Between a word and its first number, and between numbers.
constexpr std::array<std::string_view, 3> before_first = {" ", "s ", "s\": ["};
constexpr std::array<std::string_view, 3> between = {", ", " and ", "–"};

/// The length of the separator with which a text begins before a digit; 0 if there is none.
std::size_t length_before_digit(std::string_view text, const std::array<std::string_view, 3>& separators) {
  const auto fits = [&](std::string_view separator) {
    return text.starts_with(separator) && text.size() > separator.size() && text[separator.size()] >= '0' &&
           text[separator.size()] <= '9';
  };
  const auto* const found = std::find_if(separators.begin(), separators.end(), fits);
  return found == separators.end() ? 0 : found->size();
}

bool counts_nodes(WarningCode code) {
  return code == WarningCode::immovable_nodes || code == WarningCode::free_boundary ||
         code == WarningCode::untold_boundary || code == WarningCode::worse_than_input;
}

}  // namespace

std::string with_given_numbers(std::string_view text, const GivenNumbers& numbers) {
  std::string result;
  while (!text.empty()) {
    const auto begins = [&](const Numbered& kind) { return text.starts_with(kind.word); };
    const auto* const kind = std::find_if(numbered.begin(), numbered.end(), begins);
    std::size_t copied = kind == numbered.end() ? 1 : kind->word.size();
    result += text.substr(0, copied);
    text.remove_prefix(copied);
    if (kind == numbered.end()) continue;
    for (copied = length_before_digit(text, before_first); copied > 0; copied = length_before_digit(text, between)) {
      result += text.substr(0, copied);
      text.remove_prefix(copied);
      Index number = 0;
      const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
      const auto length = static_cast<std::size_t>(end - text.data());
      result += fault == std::errc() ? std::to_string((numbers.*kind->given)(number)) : text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return result;
}

std::vector<Advice> with_given_numbers(std::span<const Advice> advice, const GivenNumbers& numbers) {
  std::vector<Advice> result(advice.begin(), advice.end());
  for (Advice& one : result) one.words = with_given_numbers(one.words, numbers);
  return result;
}

void name_what_was_given(std::vector<Warning>& warnings, const GivenNumbers& numbers) {
  for (Warning& warning : warnings) {
    const char* const of_both = numbers.is_half && counts_nodes(warning.code) ? "together with the mirror image: " : "";
    warning = {warning.code, of_both + with_given_numbers(warning.fault(), numbers),
               with_given_numbers(warning.advice, numbers)};
  }
}

}  // namespace vspring
