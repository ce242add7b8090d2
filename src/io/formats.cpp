// Finds the format of a file from its name and its content.
#include "io/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/message_text.hpp"
#include "io/column_names.hpp"
#include "io/input_file.hpp"
#include "io/surface_formats.hpp"
#include "io/table.hpp"
#include "io/text_cursor.hpp"
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

/// Number of bytes that may come before the line that shows the format.
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

/// The format shown by the first line that is neither empty nor a comment, for OBJ by the first unmistakable one.
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

/// Whether it is XML whose first element may be <gpx>.
bool is_gpx(std::string_view bytes) {
  const std::string_view start = bytes.substr(byte_order_mark_length(bytes), bytes_looked_at);
  return first_word(start).starts_with('<') &&
         (start.find("<gpx") != std::string_view::npos || start.find(":gpx") != std::string_view::npos);
}

bool begins_with_numbers(const std::vector<std::string_view>& cells) {
  return cells.size() > 1 && number_of(cells[0]) && number_of(cells[1]);
}

bool names_x(const std::vector<std::string_view>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](std::string_view cell) { return cell == "x" || cell == "X"; });
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
  throw Error(ErrorCode::invalid_argument,
              extension.empty()
                  ? fmt::format("{}: has no extension that shows the format; name {}", name, listed(names, in_capitals))
                  : fmt::format("{}: {} is no format; use {}, or name one of them", name, in_quotes(extension),
                                listed(names, [](const char* format) { return std::string(".") + format; })));
}

std::optional<SurfaceFormat> detect_format(std::string_view bytes) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return SurfaceFormat::ply;
  if (is_binary_stl(bytes) || is_text_stl(bytes)) return SurfaceFormat::stl;
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

CurveFormat detect_curve_format(const InputFile& file) {
  if (const auto surface = detect_format(file.bytes)) {
    if (*surface == SurfaceFormat::obj) return CurveFormat::obj;
    file.refuse(fmt::format("its content is {}, which holds surfaces; use `vspring fair` for it", name_of(*surface)));
  }
  if (is_gpx(file.bytes)) return CurveFormat::gpx;
  const std::vector<TableLine> lines = table_lines(file.bytes);
  const auto is_row = [](const TableLine& line) { return line.kind == TableLine::Kind::row; };
  const auto first = std::find_if(lines.begin(), lines.end(), is_row);
  if (first == lines.end()) file.refuse("no row of two or three numbers is in it; choose the file of a curve");
  CellCutter cutter(' ', true);
  const auto second = std::find_if(first + 1, lines.end(), is_row);
  const bool text_first = !begins_with_numbers(cutter.cut(first->text));
  // Names of columns have the same delimiters as the rows below; the name of an aerofoil may hold anything.
  if (!text_first) return CurveFormat::xyz;
  const Cells& names = cutter.cut(first->text);
  if (names_x(names) || !find_coordinates(names).columns.empty() || find_degrees(names) || second == lines.end())
    return CurveFormat::csv;
  return begins_with_numbers(cutter.cut(second->text)) ? CurveFormat::dat : CurveFormat::csv;
}

}  // namespace vspring
