#include "io/detect_format.hpp"

#include <algorithm>

#include "io/stl_source.hpp"
#include "io/text_cursor.hpp"

namespace vspring {
namespace {

/// Lines that may come before one that shows the format.
constexpr std::size_t bytes_looked_at = std::size_t{1} << 20;

std::string_view first_word(std::string_view text) {
  const auto begin = std::find_if_not(text.begin(), text.end(), is_space);
  const auto end = std::find_if(begin, text.end(), is_space);
  return text.substr(static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin));
}

bool begins_number(std::string_view word) {
  const std::string_view digits = word.substr(
      word.find_first_not_of("+-.") == std::string_view::npos ? word.size() : word.find_first_not_of("+-."));
  return word == "nan" || word == "inf" || (!digits.empty() && digits.front() >= '0' && digits.front() <= '9');
}

bool begins_off(std::string_view word) {
  const std::size_t letters = word.find("OFF");
  return letters != std::string_view::npos && word.find_first_not_of("STCN4n") >= letters &&
         (word.size() == letters + 3 || (word[letters + 3] >= '0' && word[letters + 3] <= '9'));
}

/// What the first line that is neither empty nor a comment shows, and for OBJ the first that could be nothing else.
std::optional<SurfaceFormat> format_of_lines(std::string_view bytes) {
  std::string_view rest = bytes.substr(0, bytes_looked_at);
  bool first = true;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::string_view word = first_word(line);
    if (word.empty() || word.front() == '#') continue;
    if (first && begins_off(word)) return SurfaceFormat::off;
    if (first && begins_number(word)) return std::nullopt;
    first = false;
    const std::string_view next = first_word(line.substr(static_cast<std::size_t>(word.end() - line.begin())));
    if ((word == "v" || word == "vn" || word == "vt" || word == "f") && begins_number(next)) return SurfaceFormat::obj;
    if (word == "mtllib" || word == "usemtl") return SurfaceFormat::obj;
  }
  return std::nullopt;
}

bool is_text_stl(std::string_view bytes) {
  if (first_word(bytes.substr(0, bytes_looked_at)) != "solid") return false;
  const std::string_view start = bytes.substr(0, bytes_looked_at);
  return start.find("facet") != std::string_view::npos || start.find("endsolid") != std::string_view::npos;
}

}  // namespace

std::optional<SurfaceFormat> detect_format(std::string_view bytes) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return SurfaceFormat::ply;
  if (stl::promised_size(bytes) == bytes.size() || is_text_stl(bytes)) return SurfaceFormat::stl;
  return format_of_lines(bytes);
}

const char* name_of(SurfaceFormat format) {
  switch (format) {
    case SurfaceFormat::obj:
      return "OBJ";
    case SurfaceFormat::off:
      return "OFF";
    case SurfaceFormat::ply:
      return "PLY";
    case SurfaceFormat::stl:
      return "STL";
  }
  return "";
}

}  // namespace vspring
