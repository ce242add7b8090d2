// Rows of cells with a header or without, as spreadsheets and measuring devices write them.
#include "io/csv_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace vspring {
namespace {

/// The rows that a delimiter is found from.
constexpr std::size_t rows_looked_at = 20;

using Cells = std::vector<std::string_view>;

std::vector<TableLine> first_rows(std::string_view bytes) {
  std::vector<TableLine> rows;
  walk_lines(bytes, [&](const TableLine& line) {
    if (line.kind == TableLine::Kind::row) rows.push_back(line);
    return rows.size() < rows_looked_at;
  });
  return rows;
}

std::size_t count_numbers(const Cells& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](std::string_view cell) { return number_of(cell).has_value(); }));
}

/// "1,5;2,5" cut at its commas leaves "5;2" in the middle.
bool is_two_numbers(std::string_view cell) {
  return std::any_of(cell.begin(), cell.end(), [&](const char& c) {
    const auto at = static_cast<std::size_t>(&c - cell.data());
    return (c == ';' || c == '\t' || c == ' ') && number_of(cell.substr(0, at)) && number_of(cell.substr(at + 1));
  });
}

constexpr std::array delimiters = {';', '\t', ',', ' '};

/// The delimiter that leaves two numbers in most rows; the first of them where several do.
CellCutter find_cutter(const InputFile& file, const std::vector<TableLine>& rows) {
  char best = ' ';
  std::size_t most = 0;
  for (const char delimiter : delimiters) {
    CellCutter cutter(delimiter, true);
    const auto fitting = static_cast<std::size_t>(std::count_if(
        rows.begin(), rows.end(), [&](const TableLine& row) { return count_numbers(cutter.cut(row.text)) > 1; }));
    if (fitting <= most) continue;
    most = fitting;
    best = delimiter;
  }
  // With decimal commas no delimiter leaves numbers, or the commas themselves do.
  for (const char delimiter : delimiters) {
    if (most > 0 && (delimiter != ',' || best != ',')) continue;
    CellCutter cutter(delimiter, true);
    for (const TableLine& row : rows) {
      const Cells& cells = cutter.cut(row.text);
      if (std::any_of(cells.begin(), cells.end(), most > 0 ? is_two_numbers : has_decimal_comma))
        file.refuse_line(row.offset, "its numbers have decimal commas; write decimal points");
    }
  }
  return {best, true};
}

/// The column of the name, or the number of cells.
std::size_t column_named(const Cells& header, std::string_view name) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  const auto found = std::find_if(header.begin(), header.end(), [&](std::string_view cell) {
    return std::equal(cell.begin(), cell.end(), name.begin(), name.end(), same);
  });
  return static_cast<std::size_t>(found - header.begin());
}

/// The columns that a header names, or none.
std::vector<std::size_t> named_columns(const Cells& header) {
  std::vector<std::size_t> columns;
  for (const std::string_view name : {"x", "y", "z"}) {
    const std::size_t column = column_named(header, name);
    if (column < header.size()) columns.push_back(column);
    if (column == header.size() && name != "z") return {};
  }
  return columns;
}

std::optional<std::size_t> weight_column(const Cells& header) {
  for (const std::string_view name : {"weight", "confidence"}) {
    const std::size_t column = column_named(header, name);
    if (column < header.size()) return column;
  }
  return std::nullopt;
}

std::vector<std::size_t> normal_columns(const Cells& header) {
  std::vector<std::size_t> columns;
  for (const std::string_view name : {"nx", "ny", "nz"}) columns.push_back(column_named(header, name));
  if (*std::max_element(columns.begin(), columns.end()) == header.size()) return {};
  return columns;
}

std::vector<std::size_t> number_columns(const Cells& cells) {
  std::vector<std::size_t> columns;
  for (std::size_t column = 0; column < cells.size() && columns.size() < 3; ++column) {
    if (number_of(cells[column])) columns.push_back(column);
  }
  return columns;
}

}  // namespace

CsvLayout find_csv_layout(const InputFile& file) {
  const std::vector<TableLine> rows = first_rows(file.bytes);
  if (rows.empty()) file.refuse("no row of two or three numbers is in it; choose another file");
  CsvLayout layout{find_cutter(file, rows), {}, {}, {}, {}, {}};
  const Cells first = layout.cutter.cut(rows.front().text);
  layout.columns = named_columns(first);
  const bool named = !layout.columns.empty();
  if (named || count_numbers(first) == 0) layout.header = rows.front().offset;
  if (layout.header && rows.size() == 1) file.refuse("no row of two or three numbers is in it; choose another file");
  const TableLine& row = rows[layout.header ? 1 : 0];
  if (!named) layout.columns = number_columns(layout.cutter.cut(row.text));
  if (layout.columns.size() < 2)
    file.refuse_line(row.offset,
                     "a node needs two or three numbers, this row has fewer; repair it, or choose another file");
  if (!layout.header) return layout;
  layout.weight = weight_column(first);
  layout.normal = normal_columns(first);
  if (!named)
    layout.warning = fmt::format("{}:{}: no columns are named x and y; taken are columns {} and {}{}", file.name,
                                 file.line_of(*layout.header), layout.columns[0] + 1, layout.columns[1] + 1,
                                 layout.columns.size() == 3 ? fmt::format(" and {}", layout.columns[2] + 1) : "");
  return layout;
}

}  // namespace vspring
