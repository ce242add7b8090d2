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
#include "io/csv_cutter.hpp"
#include "io/degrees.hpp"
#include "io/rewriter.hpp"
#include "io/table.hpp"

namespace vspring {
namespace {

/// How to read the rows of a CSV file.
struct CsvLayout {
  CellCutter cutter;
  std::vector<std::size_t> columns;   ///< of x, y and, in space, z
  std::optional<std::size_t> header;  ///< offset of the row that names columns, or of a row of units below it
  std::optional<std::size_t> weight;  ///< column that the header names weight or, without one, confidence
  std::vector<std::size_t> normal;    ///< columns that the header names nx, ny and nz; or none
  std::string warning;                ///< set if columns had to be guessed
  bool degrees = false;               ///< the first two columns are longitude and latitude
  std::vector<std::string> names;     ///< of the columns in the header; none without
};

/// Finds the columns of coordinates: the chosen ones, else those that a header names (find_coordinates(),
/// find_degrees()), else the first ones of numbers. Throws Error(unusable_file), also if these may be something else,
/// and Error(invalid_argument) for an invalid choice.
CsvLayout find_csv_layout(const InputFile& file, const ColumnChoice& choice);

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

/// The cells of a header separated by blanks: a unit in brackets belongs to the cell before.
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

/// "2,3" for columns 1 and 2.
std::string numbers_of(std::span<const std::size_t> columns, const char* between) {
  std::string text;
  for (const std::size_t column : columns) text += (text.empty() ? "" : between) + fmt::to_string(column + 1);
  return text;
}

/// Takes the first two or three columns of numbers for coordinates, if they can be nothing else.
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
  if (layout.header ? many || counts : many && counts) {
    std::vector<Advice> advice = {{Remedy::columns, "choose columns, such as " + choice}};
    if (layout.header) advice.insert(advice.begin(), {Remedy::input, "name them x, y and z"});
    file.refuse_line(where,
                     fmt::format("{}{}{}, so columns {} cannot be told apart",
                                 counts ? fmt::format("column {} counts rows", columns.front() + 1) : "",
                                 counts && layout.header ? " and " : "",
                                 layout.header ? "no columns are named x and y" : "", numbers_of(columns, ", ")),
                     std::move(advice));
  }
  if (many) columns.resize(3);
  if (layout.header)
    layout.warning = fmt::format("{}:{}: no columns are named x and y; taken are columns {}", file.name,
                                 file.line_of(where), numbers_of(columns, " and "));
  else if (counts)
    layout.warning = fmt::format("{}:{}: column {} counts rows and is taken for x; if it is none, choose columns {}",
                                 file.name, file.line_of(where), columns.front() + 1, choice);
  layout.columns = std::move(columns);
}

bool is_name(const std::string& chosen) { return !number_of(chosen); }

/// Whether the first row is a header, with columns that were chosen.
bool is_header(const Cells& first, char decimal_mark, const std::vector<std::size_t>& columns,
               const ColumnChoice& choice) {
  const auto holds_number = [&](std::size_t column) {
    return column < first.size() && number_of(first[column], decimal_mark);
  };
  const auto is_there = [&](std::size_t column) { return column < first.size(); };
  if (std::any_of(choice.begin(), choice.end(), is_name)) return true;
  if (std::any_of(columns.begin(), columns.end(), holds_number)) return false;
  return count_numbers(first, decimal_mark) == 0 || std::any_of(columns.begin(), columns.end(), is_there);
}

/// Such as "mm,mm", below names and above numbers.
bool is_row_of_units(CellCutter cutter, const TableLine& row, const TableLine& next) {
  const char mark = cutter.decimal_mark();
  return count_numbers(cutter.cut(row.text), mark) == 0 && count_numbers(cutter.cut(next.text), mark) > 1;
}

/// Among chosen columns, longitude and latitude are x and y in either order; a third one is z.
void put_degrees_first(const Cells& header, CsvLayout& layout) {
  Cells chosen;
  for (const std::size_t column : layout.columns) chosen.push_back(column < header.size() ? header[column] : "");
  const auto degrees = find_degrees(chosen);
  if (!degrees) return;
  layout.degrees = true;
  std::vector<std::size_t> columns = {layout.columns[(*degrees)[0]], layout.columns[(*degrees)[1]]};
  if (chosen.size() > 2) columns.push_back(layout.columns[3 - (*degrees)[0] - (*degrees)[1]]);
  layout.columns = std::move(columns);
}

CsvLayout find_csv_layout(const InputFile& file, const ColumnChoice& choice) {
  const char* const no_rows = "no row of two or three numbers is in it; choose another file";
  const std::vector<TableLine> all_rows = first_rows(file.bytes);
  std::span<const TableLine> rows = all_rows;
  if (rows.empty()) file.refuse(no_rows);
  CsvLayout layout{find_cutter(file, all_rows), {}, {}, {}, {}, {}, false, {}};
  refuse_cells_of_several_lines(file, layout.cutter);
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
    file.refuse_line(offset, named.doubt,
                     {{Remedy::input, "rename one"}, {Remedy::columns, "choose columns by number, such as 2,3"}});
  const char mark = layout.cutter.decimal_mark();
  if (choice.empty() && named.columns.empty()) {
    if (const auto degrees = find_degrees(first)) {
      named.columns.assign(degrees->begin(), degrees->end());
      layout.degrees = true;
    }
  }
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
  // Columns that are chosen by number say how rows are cut.
  if (std::all_of(choice.begin(), choice.end(), is_name))
    refuse_commas_in_numbers(file, layout.cutter, rows, layout.header ? first.size() : 0);
  if (!choice.empty()) {
    require_columns(file, layout.cutter.cut(rows.front().text), rows.front().offset, layout.columns);
    if (layout.header) put_degrees_first(first, layout);
  } else if (named.columns.empty()) {
    guess_columns(file, rows, layout);
  } else {
    layout.columns = std::move(named.columns);
    if (!named.remark.empty()) layout.warning = fmt::format("{}:{}: {}", file.name, file.line_of(offset), named.remark);
  }
  for (const std::size_t column : layout.columns) {
    if (layout.header) layout.names.emplace_back(column < first.size() ? first[column] : "");
  }
  return layout;
}

}  // namespace

CurveFile read_csv_curve(InputFile file, const ColumnChoice& choice, const std::optional<LocalPlane>& plane) {
  const CsvLayout layout = find_csv_layout(file, choice);
  const std::vector<TableLine> lines = table_lines(file.bytes);
  TableReader reader(file, layout.cutter, layout.columns, layout.degrees);
  std::span<const TableLine> body = lines;
  if (layout.header) {
    reader.carry(column_names_carried);
    while (body.front().offset != *layout.header) {
      if (body.front().kind == TableLine::Kind::comment) reader.carry("comments");
      body = body.subspan(1);
    }
    body = body.subspan(1);
  }
  reader.read(body);
  CurveFile curve = reader.take(std::move(file), CurveFormat::csv, plane);
  if (!layout.warning.empty()) curve.warnings.push_back(layout.warning);
  curve.column_names = layout.names;
  return curve;
}

ScatteredPoints read_csv_points(const InputFile& file, const ColumnChoice& choice,
                                const std::optional<LocalPlane>& plane) {
  const CsvLayout layout = find_csv_layout(file, choice);
  ScatteredPoints points =
      read_point_rows(file, layout.cutter, {layout.columns, layout.weight, layout.normal, layout.degrees},
                      layout.header ? *layout.header + 1 : 0, {}, plane);
  if (!layout.warning.empty()) points.warnings.push_back(layout.warning);
  return points;
}

std::string fresh_csv(const FreshCurve& curve, std::vector<std::string>& losses) {
  name_losses_of_rows(curve, losses);
  std::string text;
  if (curve.plane == nullptr) {
    text = curve.planar ? "x,y\n" : "x,y,z\n";
    append_rows(text, curve, ',');
    return text;
  }
  text = curve.planar ? "lat,lon\n" : "lat,lon,ele\n";
  const auto append_row = [&](const Vector3& position) {
    const LocalPlane::Place place = curve.plane->place(position);
    append_degrees(text, place.latitude);
    text += ',';
    append_degrees(text, place.longitude);
    if (!curve.planar) text += ',';
    if (!curve.planar) append_number(text, position.z());
    text += '\n';
  };
  walk_rows(curve, append_row, [&] { text += '\n'; });
  return text;
}

}  // namespace vspring
