// Columns of coordinates, as a header names them or a user chooses them.
#include "io/column_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <span>
#include <system_error>
#include <utility>

#include "base/message_text.hpp"
#include "io/text_cursor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

/// Names of x, y and z that go together.
using Axes = std::array<std::string_view, 3>;
constexpr std::array<Axes, 6> known_axes = {{{"x", "y", "z"},
                                             {"station", "y", "z"},
                                             {"east", "north", "up"},
                                             {"easting", "northing", "elevation"},
                                             {"points:0", "points:1", "points:2"},
                                             {"points_0", "points_1", "points_2"}}};

/// What may follow a name: units of length, and words for a coordinate.
constexpr std::array<std::string_view, 27> known_words = {
    "mm",    "cm",     "dm",     "m",      "km",         "um",          "\u00b5m", "\u03bcm",  "nm",
    "in",    "inch",   "inches", "ft",     "feet",       "foot",        "yd",      "mi",       "px",
    "pixel", "pixels", "coord",  "coords", "coordinate", "coordinates", "pos",     "position", "axis"};

bool is_same(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char p, char q) { return lower(p) == lower(q); });
}

/// "x" of "x [mm]". A rate, as in "x [m/s]", is no coordinate and keeps its brackets.
std::string_view without_brackets(std::string_view cell) {
  const std::size_t open = cell.find_first_of("[({");
  if (open == std::string_view::npos || cell.find('/', open) != std::string_view::npos ||
      std::string_view("])}").find(cell.back()) == std::string_view::npos)
    return cell;
  cell = cell.substr(0, open);
  while (!cell.empty() && is_space(cell.back())) cell.remove_suffix(1);
  return cell;
}

/// Whether a cell is the name followed by a unit.
bool has_name(std::string_view cell, std::string_view name) {
  constexpr std::string_view separators = " \t_-.:";
  cell = without_brackets(cell);
  if (!is_same(cell.substr(0, name.size()), name)) return false;
  std::string_view rest = cell.substr(name.size());
  const std::size_t slash = rest.find('/');
  if (slash != std::string_view::npos)
    return rest.find_first_not_of(separators) == slash &&
           rest.find_first_not_of(separators, slash + 1) != std::string_view::npos &&
           rest.find('/', slash + 1) == std::string_view::npos;
  while (!rest.empty()) {
    const std::size_t begin = std::min(rest.find_first_not_of(separators), rest.size());
    if (begin == 0) return false;
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(separators));
    if (!word.empty() && std::none_of(known_words.begin(), known_words.end(),
                                      [&](std::string_view known) { return is_same(word, known); }))
      return false;
    rest.remove_prefix(word.size());
  }
  return true;
}

/// A column by its name, alone or with a unit.
struct Found {
  std::size_t column;  ///< the number of cells if there is none
  std::string doubt = {};
};

Found find_name(const Cells& header, std::string_view name) {
  const std::size_t exact = column_named(header, name);
  if (exact < header.size()) return {exact};
  const auto fits = [&](std::string_view cell) { return has_name(cell, name); };
  const auto first = std::find_if(header.begin(), header.end(), fits);
  Found found{static_cast<std::size_t>(first - header.begin())};
  if (first == header.end()) return found;
  const auto second = std::find_if(first + 1, header.end(), fits);
  if (second != header.end())
    found.doubt = fmt::format("{} and {} may both be {}", in_quotes(*first), in_quotes(*second), name);
  return found;
}

NamedCoordinates find_axes(const Cells& header, const Axes& axes) {
  NamedCoordinates named;
  std::string names;
  bool in_plane = true;
  for (const std::string_view axis : axes) {
    const Found found = find_name(header, axis);
    if (found.column == header.size()) continue;
    named.columns.push_back(found.column);
    if (!found.doubt.empty()) named.doubt = found.doubt;
    names += (names.empty() ? "" : " and ") + in_quotes(header[found.column]);
    in_plane = axis != axes.back();
  }
  if (named.columns.size() < 2) return {};
  if (named.columns.size() == 2 && !in_plane)
    named.remark = fmt::format("the columns {} are taken for x and y of a plane", names);
  return named;
}

/// Whether a cell is one of the names, alone or followed by a unit of degrees.
bool has_name_in_degrees(std::string_view cell, std::span<const std::string_view> names) {
  constexpr std::string_view separators = " \t_-.";
  constexpr std::array<std::string_view, 5> units = {"", "deg", "degree", "degrees", "\u00b0"};
  cell = without_brackets(cell);
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
    if (!is_same(cell.substr(0, name.size()), name)) return false;
    const std::string_view behind = cell.substr(name.size());
    const std::string_view unit = behind.substr(std::min(behind.find_first_not_of(separators), behind.size()));
    return std::any_of(units.begin(), units.end(), [&](std::string_view known) { return is_same(unit, known); }) &&
           (behind.empty() || unit.size() < behind.size());
  });
}

std::string list_of(const Cells& header) {
  constexpr std::size_t most = 8;
  std::string list;
  for (std::size_t column = 0; column < std::min(header.size(), most); ++column)
    list += (column == 0 ? "" : ", ") + in_quotes(header[column]);
  return list + (header.size() > most ? ", …" : "");
}

/// The column number of a choice; 0 for a name.
std::size_t number_chosen(const std::string& chosen) {
  if (chosen.find_first_not_of("0123456789") != std::string::npos) return 0;
  std::size_t number = 0;
  const auto [end, fault] = std::from_chars(chosen.data(), chosen.data() + chosen.size(), number);
  if (number == 0 || fault != std::errc())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} is no column; give its number, from 1, or its name", in_quotes(chosen)));
  return number;
}

std::vector<Advice> correct_choice() { return {{Remedy::columns, "correct the choice of columns"}}; }

}  // namespace

NamedCoordinates find_coordinates(const Cells& header) {
  NamedCoordinates best;
  for (const Axes& axes : known_axes) {
    NamedCoordinates named = find_axes(header, axes);
    if (named.columns.size() > best.columns.size()) best = std::move(named);
  }
  return best;
}

std::optional<std::array<std::size_t, 2>> find_degrees(const Cells& header) {
  constexpr std::array<std::string_view, 4> longitudes = {"longitude", "lon", "lng", "long"};
  constexpr std::array<std::string_view, 2> latitudes = {"latitude", "lat"};
  const auto find = [&](std::span<const std::string_view> names) {
    const auto found = std::find_if(header.begin(), header.end(),
                                    [&](std::string_view cell) { return has_name_in_degrees(cell, names); });
    return static_cast<std::size_t>(found - header.begin());
  };
  const std::array found = {find(longitudes), find(latitudes)};
  if (found[0] == header.size() || found[1] == header.size()) return std::nullopt;
  return found;
}

std::size_t column_named(const Cells& header, std::string_view name) {
  const auto found =
      std::find_if(header.begin(), header.end(), [&](std::string_view cell) { return is_same(cell, name); });
  return static_cast<std::size_t>(found - header.begin());
}

std::size_t column_like(const Cells& header, std::string_view name) { return find_name(header, name).column; }

bool chooses_elevations(const InputFile& file, const ColumnChoice& choice) {
  if (choice.empty()) return false;
  const Cells cells(choice.begin(), choice.end());
  const bool elevations = column_named(cells, "ele") < cells.size();
  if (!find_degrees(cells) || cells.size() != (elevations ? 3 : 2))
    throw Error(ErrorCode::invalid_argument, file.name + ": columns of a track are lon,lat or lon,lat,ele",
                correct_choice());
  return elevations;
}

std::vector<std::size_t> chosen_columns(const InputFile& file, const Cells& first, std::size_t offset,
                                        const ColumnChoice& choice) {
  if (choice.size() != 2 && choice.size() != 3)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("2 or 3 columns have to be chosen, of x, y and, in space, z, not {}", choice.size()));
  std::vector<std::size_t> columns;
  for (const std::string& chosen : choice) {
    const std::size_t number = number_chosen(chosen);
    const Found found = number > 0 ? Found{number - 1} : find_name(first, chosen);
    if (number == 0 && found.column == first.size())
      file.refuse_line(offset,
                       fmt::format("no column is called {}, this row has {}", in_quotes(chosen), list_of(first)),
                       correct_choice());
    if (!found.doubt.empty()) file.refuse_line(offset, found.doubt, {{Remedy::columns, "choose columns by number"}});
    if (std::find(columns.begin(), columns.end(), found.column) != columns.end())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("column {} is chosen twice; x, y and z need one each", found.column + 1));
    columns.push_back(found.column);
  }
  return columns;
}

void refuse_choice(const InputFile& file, const ColumnChoice& choice) {
  if (!choice.empty())
    throw Error(ErrorCode::invalid_argument, file.name + ": columns can be chosen in CSV, XYZ and GPX only",
                {{Remedy::columns, "leave the choice of columns out"}, {Remedy::format, "name the format"}});
}

void require_columns(const InputFile& file, const Cells& row, std::size_t offset,
                     const std::vector<std::size_t>& columns) {
  const std::size_t last = *std::max_element(columns.begin(), columns.end());
  if (last >= row.size())
    file.refuse_line(offset, fmt::format("column {} is chosen, this row has {}", last + 1, row.size()),
                     correct_choice());
}

}  // namespace vspring
