#include "io/format_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/message_text.hpp"
#include "io/input_file.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

std::string in_capitals(std::string_view name) {
  std::string capitals(name);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

/// "a, b or c", each name changed by `change`.
template <typename Change>
std::string listed(FormatNames names, const Change& change) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += k + 1 == names.size() ? " or " : ", ";
    text += change(names[k]);
  }
  return text;
}

}  // namespace

std::string extension_of(const std::string& path) {
  return path == "-" ? "" : std::filesystem::path(path).extension().string();
}

std::optional<std::size_t> format_of_extension(std::string_view extension, FormatNames names) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  std::string lower(extension);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::find(names.begin(), names.end(), lower);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t format_to_write(const std::string& path, std::optional<std::size_t> asked, std::optional<std::size_t> own,
                            FormatNames names) {
  if (asked) return *asked;
  const std::string extension = extension_of(path);
  if (const auto format = format_of_extension(extension, names)) return *format;
  if (extension.empty() && own) return *own;
  const std::string name = path == "-" ? "standard output" : path;
  throw Error(
      ErrorCode::invalid_argument,
      extension.empty()
          ? fmt::format("{}: without an extension it shows no format; name {}", name, listed(names, in_capitals))
          : fmt::format("{}: {} is no format; use {}, or name one of them", name, in_quotes(extension),
                        listed(names, [](const char* format) { return std::string(".") + format; })));
}

}  // namespace vspring
