// CSV: one node or point per row of cells, with a header or without, as spreadsheets and measuring devices write it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/column_names.hpp"
#include "io/table.hpp"

namespace vspring {
namespace {

/// How the rows of a CSV file are to be read.
struct CsvLayout {
  CellCutter cutter;
  std::vector<std::size_t> columns;   ///< of x, y and, in space, z
  std::optional<std::size_t> header;  ///< offset of the row that names columns, or of one of units below it
  std::optional<std::size_t> weight;  ///< column that the header names weight or, without one, confidence
  std::vector<std::size_t> normal;    ///< columns that the header names nx, ny and nz; or none
  std::string warning;                ///< of columns that had to be guessed; empty without
};

/// Finds the delimiter and the columns of coordinates: those that are chosen, else those that a header names, see
/// find_coordinates(), else the first ones of numbers, where these can be told from others. Throws
/// Error(unusable_file), and Error(invalid_argument) for a choice that is none.
CsvLayout find_csv_layout(const InputFile& file, const ColumnChoice& choice);

/// The rows that a delimiter is found from.
constexpr std::size_t rows_looked_at = 20;

std::vector<TableLine> first_rows(std::string_view bytes) {
  std::vector<TableLine> rows;
  walk_lines(bytes, [&](const TableLine& line) {
    if (line.kind == TableLine::Kind::row) rows.push_back(line);
    return rows.size() < rows_looked_at;
  });
  return rows;
}

std::size_t count_numbers(const Cells& cells, char decimal_mark) {
  const auto is_number = [&](std::string_view cell) { return number_of(cell, decimal_mark).has_value(); };
  return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), is_number));
}

/// "1,5;2,5" cut at its commas leaves "5;2" in the middle.
bool is_two_numbers(std::string_view cell) {
  return std::any_of(cell.begin(), cell.end(), [&](const char& c) {
    const auto at = static_cast<std::size_t>(&c - cell.data());
    return (c == ';' || c == '\t' || c == ' ') && number_of(cell.substr(0, at)) && number_of(cell.substr(at + 1));
  });
}

constexpr std::array delimiters = {';', '\t', ',', ' '};

/// What a delimiter and a decimal mark make of rows.
struct TriedCutter {
  CellCutter cutter;
  std::size_t numbers = 0;
  std::size_t fitting = 0;  ///< rows of two numbers or more
};

TriedCutter try_cutter(const std::vector<TableLine>& rows, char delimiter, char decimal_mark) {
  TriedCutter tried{{delimiter, true, decimal_mark}};
  for (const TableLine& row : rows) {
    const std::size_t numbers = count_numbers(tried.cutter.cut(row.text), decimal_mark);
    tried.numbers += numbers;
    if (numbers > 1) ++tried.fitting;
  }
  return tried;
}

/// Whether the first row with a number that is none with the other decimal mark has a comma. The first rows of a table
/// may be whole numbers alone.
bool has_commas_below(std::string_view bytes, CellCutter cutter) {
  bool commas = false;
  walk_lines(bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row) return true;
    const Cells& cells = cutter.cut(line.text);
    const std::size_t with_points = count_numbers(cells, '.');
    const std::size_t with_commas = count_numbers(cells, ',');
    commas = with_commas > with_points;
    return with_commas == with_points;
  });
  return commas;
}

/// The delimiter that leaves two numbers in most rows; the first of them where several do. Decimal commas where they
/// leave more numbers than points.
CellCutter find_cutter(const InputFile& file, const std::vector<TableLine>& rows) {
  TriedCutter best{{' ', true}};
  bool whole = false;
  char cuts = ' ';
  for (const char delimiter : delimiters) {
    TriedCutter tried = try_cutter(rows, delimiter, '.');
    const TriedCutter with_commas = try_cutter(rows, delimiter, delimiter == ' ' ? '.' : ',');
    const bool same = tried.numbers == with_commas.numbers;
    if (with_commas.numbers > tried.numbers) tried = with_commas;
    if (tried.fitting <= best.fitting) continue;
    best = tried;
    whole = same;
    cuts = delimiter;
  }
  // Between blanks the program would have to guess which commas are decimal ones: then no delimiter leaves numbers, or
  // the commas themselves do.
  for (const TableLine& row : rows) {
    if (best.fitting > 0 && cuts != ',') break;
    const Cells& cells = best.cutter.cut(row.text);
    if (std::any_of(cells.begin(), cells.end(), best.fitting > 0 ? is_two_numbers : has_decimal_comma))
      file.refuse_line(row.offset,
                       "its numbers have decimal commas, and blanks between them; write decimal points, or "
                       "semicolons in place of the blanks");
  }
  const bool may_have_commas =
      cuts == ';' || cuts == '\t' || (cuts == ',' && file.bytes.find('"') != std::string::npos);
  if (whole && may_have_commas && has_commas_below(file.bytes, best.cutter)) return {cuts, true, ','};
  return best.cutter;
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

/// The cells of a header between blanks, of which a unit in brackets is none of its own.
Cells with_units(const Cells& cells) {
  Cells header;
  bool open = false;
  for (const std::string_view cell : cells) {
    const bool opens = cell.starts_with('[') || cell.starts_with('(');
    if ((opens || open) && !header.empty())
      header.back() = {header.back().data(),
                       static_cast<std::size_t>(cell.data() + cell.size() - header.back().data())};
    else
      header.push_back(cell);
    open = (opens || open) && !cell.ends_with(']') && !cell.ends_with(')');
  }
  return header;
}

std::vector<std::size_t> number_columns(const Cells& cells, char decimal_mark) {
  std::vector<std::size_t> columns;
  for (std::size_t column = 0; column < cells.size(); ++column) {
    if (number_of(cells[column], decimal_mark)) columns.push_back(column);
  }
  return columns;
}

/// Whether the cells of a column count the rows, from 0 or 1.
bool counts_rows(std::span<const TableLine> rows, CellCutter cutter, std::size_t column) {
  constexpr std::size_t fewest = 3;
  if (rows.size() < fewest) return false;
  double first = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Cells& cells = cutter.cut(rows[row].text);
    const std::optional<double> number =
        column < cells.size() ? number_of(cells[column], cutter.decimal_mark()) : std::nullopt;
    if (row == 0) first = number.value_or(-1);
    if (number != first + static_cast<double>(row)) return false;
  }
  return first == 0 || first == 1;
}

/// "2,3" of columns 1 and 2.
std::string numbers_of(std::span<const std::size_t> columns, const char* between) {
  std::string text;
  for (const std::size_t column : columns) text += (text.empty() ? "" : between) + fmt::to_string(column + 1);
  return text;
}

/// Takes the first two or three columns of numbers for coordinates, where nothing speaks against it.
void guess_columns(const InputFile& file, std::span<const TableLine> rows, CsvLayout& layout) {
  std::vector<std::size_t> columns = number_columns(layout.cutter.cut(rows.front().text), layout.cutter.decimal_mark());
  if (columns.size() > 3)
    std::erase_if(columns, [&](std::size_t column) {
      return column == layout.weight || std::count(layout.normal.begin(), layout.normal.end(), column) > 0;
    });
  if (columns.size() < 2)
    file.refuse_line(rows.front().offset,
                     "a node needs two or three numbers, this row has fewer; repair it, or choose another file");
  const std::size_t where = layout.header.value_or(rows.front().offset);
  const std::size_t others = std::min<std::size_t>(columns.size() - 1, 3);
  const std::string choice = numbers_of(std::span(columns).subspan(1, others), ",");
  const bool counts = columns.size() > 2 && counts_rows(rows, layout.cutter, columns.front());
  const bool many = columns.size() > 3;
  if (layout.header ? many || counts : many && counts)
    file.refuse_line(
        where, fmt::format("{}{}{}, so columns {} cannot be told apart; {}choose columns, such as {}",
                           counts ? fmt::format("column {} counts rows", columns.front() + 1) : "",
                           counts && layout.header ? " and " : "", layout.header ? "no columns are named x and y" : "",
                           numbers_of(columns, ", "), layout.header ? "name them x, y and z, or " : "", choice));
  if (many) columns.resize(3);
  if (layout.header)
    layout.warning = fmt::format("{}:{}: no columns are named x and y; taken are columns {}", file.name,
                                 file.line_of(where), numbers_of(columns, " and "));
  else if (counts)
    layout.warning = fmt::format("{}:{}: column {} counts rows and is taken for x; if it is none, choose columns {}",
                                 file.name, file.line_of(where), columns.front() + 1, choice);
  layout.columns = std::move(columns);
}

/// Whether the first row is a header, with columns that were chosen.
bool is_header(const Cells& first, char decimal_mark, const std::vector<std::size_t>& columns,
               const ColumnChoice& choice) {
  const auto is_name = [](const std::string& chosen) { return !number_of(chosen); };
  const auto holds_number = [&](std::size_t column) {
    return column < first.size() && number_of(first[column], decimal_mark);
  };
  const auto is_there = [&](std::size_t column) { return column < first.size(); };
  if (std::any_of(choice.begin(), choice.end(), is_name)) return true;
  if (std::any_of(columns.begin(), columns.end(), holds_number)) return false;
  return count_numbers(first, decimal_mark) == 0 || std::any_of(columns.begin(), columns.end(), is_there);
}

/// Below names, above numbers: "mm,mm".
bool is_row_of_units(CellCutter cutter, const TableLine& row, const TableLine& next) {
  const char mark = cutter.decimal_mark();
  return count_numbers(cutter.cut(row.text), mark) == 0 && count_numbers(cutter.cut(next.text), mark) > 1;
}

CsvLayout find_csv_layout(const InputFile& file, const ColumnChoice& choice) {
  const char* const no_rows = "no row of two or three numbers is in it; choose another file";
  const std::vector<TableLine> all_rows = first_rows(file.bytes);
  std::span<const TableLine> rows = all_rows;
  if (rows.empty()) file.refuse(no_rows);
  CsvLayout layout{find_cutter(file, all_rows), {}, {}, {}, {}, {}};
  const std::size_t cells_below = rows.size() > 1 ? layout.cutter.cut(rows[1].text).size() : 0;
  Cells first = layout.cutter.cut(rows.front().text);
  if (layout.cutter.cuts_at_blanks() && first.size() > cells_below) first = with_units(first);
  const std::size_t offset = rows.front().offset;
  NamedCoordinates named;
  if (choice.empty())
    named = find_coordinates(first);
  else
    layout.columns = chosen_columns(file, first, offset, choice);
  if (!named.doubt.empty())
    file.refuse_line(offset, named.doubt + "; rename one, or choose columns by number, such as 2,3");
  const char mark = layout.cutter.decimal_mark();
  if (choice.empty() ? !named.columns.empty() || count_numbers(first, mark) == 0
                     : is_header(first, mark, layout.columns, choice)) {
    layout.header = offset;
    layout.weight = weight_column(first);
    layout.normal = normal_columns(first);
    rows = rows.subspan(1);
    if (rows.empty()) file.refuse(no_rows);
    if (rows.size() > 1 && is_row_of_units(layout.cutter, rows[0], rows[1])) {
      layout.header = rows.front().offset;
      rows = rows.subspan(1);
    }
  }
  if (!choice.empty()) {
    require_columns(file, layout.cutter.cut(rows.front().text), rows.front().offset, layout.columns);
  } else if (named.columns.empty()) {
    guess_columns(file, rows, layout);
  } else {
    layout.columns = std::move(named.columns);
    if (!named.remark.empty()) layout.warning = fmt::format("{}:{}: {}", file.name, file.line_of(offset), named.remark);
  }
  return layout;
}

}  // namespace

CurveFile read_csv_curve(InputFile file, const ColumnChoice& choice) {
  const CsvLayout layout = find_csv_layout(file, choice);
  const std::vector<TableLine> lines = table_lines(file.bytes);
  TableReader reader(file, layout.cutter, layout.columns);
  std::span<const TableLine> body = lines;
  if (layout.header) {
    reader.carry("names of columns");
    while (body.front().offset != *layout.header) {
      if (body.front().kind == TableLine::Kind::comment) reader.carry("comments");
      body = body.subspan(1);
    }
    body = body.subspan(1);
  }
  reader.read(body);
  CurveFile curve = reader.take(std::move(file), CurveFormat::csv);
  if (!layout.warning.empty()) curve.warnings.push_back(layout.warning);
  return curve;
}

ScatteredPoints read_csv_points(const InputFile& file, const ColumnChoice& choice) {
  const CsvLayout layout = find_csv_layout(file, choice);
  ScatteredPoints points = read_point_rows(file, layout.cutter, {layout.columns, layout.weight, layout.normal},
                                           layout.header ? *layout.header + 1 : 0);
  if (!layout.warning.empty()) points.warnings.push_back(layout.warning);
  return points;
}

std::string fresh_csv(const FreshCurve& curve, std::vector<std::string>& losses) {
  name_losses_of_rows(curve, losses);
  std::string text = curve.planar ? "x,y\n" : "x,y,z\n";
  append_rows(text, curve, ',');
  return text;
}

}  // namespace vspring
