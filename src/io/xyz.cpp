// XYZ: rows of two or three numbers, and anything after them, separated by white space; a header or none.
#include <fmt/format.h>

#include <algorithm>
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

std::size_t count_coordinates(std::span<const std::string_view> cells) {
  std::size_t count = 0;
  while (count < std::min<std::size_t>(cells.size(), 3) && number_of(cells[count])) ++count;
  return count;
}

/// The numbers that a row begins with.
std::size_t count_leading_numbers(std::span<const std::string_view> cells) {
  const auto end = std::find_if(cells.begin(), cells.end(), [](std::string_view cell) { return !number_of(cell); });
  return static_cast<std::size_t>(end - cells.begin());
}

/// Whether numbers four to six are a normal, and not a colour.
bool is_unit_or_zero(std::span<const std::string_view> cells) {
  const Vector3 vector(*number_of(cells[3]), *number_of(cells[4]), *number_of(cells[5]));
  return is_point_normal(vector);
}

/// Whether words stand in the first row, and numbers below.
bool has_header(const InputFile& file) {
  CellCutter cutter(' ', false);
  std::vector<std::size_t> numbers;
  walk_lines(file.bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row) return true;
    const Cells& cells = cutter.cut(line.text);
    numbers.push_back(static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [](std::string_view cell) { return number_of(cell).has_value(); })));
    return numbers.size() < 2;
  });
  return numbers.size() == 2 && numbers[0] == 0 && numbers[1] > 1;
}

}  // namespace

CurveFile read_xyz_curve(InputFile file, const ColumnChoice& choice, const std::optional<LocalPlane>& plane) {
  // Its names are those of CSV.
  if (has_header(file)) {
    CurveFile curve = read_csv_curve(std::move(file), choice, plane);
    curve.format = CurveFormat::xyz;
    return curve;
  }
  const std::vector<TableLine> lines = table_lines(file.bytes);
  const auto is_row = [](const TableLine& line) { return line.kind == TableLine::Kind::row; };
  const auto first = std::find_if(lines.begin(), lines.end(), is_row);
  if (first == lines.end()) file.refuse("no row of two or three numbers is in it; choose the file of a curve");
  CellCutter cutter(' ', false);
  const Cells cells = cutter.cut(first->text);
  const std::size_t count = count_coordinates(cells);
  std::vector<std::size_t> columns = count == 3 ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0, 1};
  if (!choice.empty()) {
    columns = chosen_columns(file, cells, first->offset, choice);
    require_columns(file, cells, first->offset, columns);
  }
  TableReader reader(file, cutter, std::move(columns));
  // In a file of planar and space curves one kind would be misread.
  for (const TableLine& line : lines) {
    if (!choice.empty() || count != 2 || !is_row(line) || count_coordinates(cutter.cut(line.text)) < 3) continue;
    file.refuse_line(line.offset, "this row has three numbers, the first row has two; correct one of them");
  }
  reader.read(lines);
  return reader.take(std::move(file), CurveFormat::xyz);
}

ScatteredPoints read_xyz_points(const InputFile& file, const ColumnChoice& choice,
                                const std::optional<LocalPlane>& plane) {
  if (has_header(file)) return read_csv_points(file, choice, plane);
  CellCutter cutter(' ', false);
  std::size_t numbers = 0;
  std::size_t cells_of_first = 0;
  bool faces = false;
  std::vector<std::size_t> chosen;
  walk_lines(file.bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row) return true;
    const std::vector<std::string_view>& cells = cutter.cut(line.text);
    numbers = count_leading_numbers(cells);
    cells_of_first = cells.size();
    if (!choice.empty()) {
      chosen = chosen_columns(file, cells, line.offset, choice);
      require_columns(file, cells, line.offset, chosen);
    }
    faces = (numbers == 6 || numbers == 7) && numbers == cells_of_first && is_unit_or_zero(cells);
    return false;
  });
  if (cells_of_first == 0) file.refuse("no row of two or three numbers is in it; choose another file");
  // With chosen columns nothing is guessed.
  if (!choice.empty()) return read_point_rows(file, cutter, {chosen}, 0);
  const bool planar = numbers < 3;
  PointColumns columns{{0, 1}};
  if (!planar) columns.coordinates.push_back(2);
  if (numbers == cells_of_first && (numbers == 4 || numbers == 7)) columns.weight = numbers - 1;
  if (faces) columns.normal = {3, 4, 5};
  return read_point_rows(file, cutter, columns, 0, [&](const TableLine& line, const auto& cells) {
    // In a mix of planar and space points, or of points with and without weights, some would be misread.
    if ((planar && count_leading_numbers(cells) > 2) || ((columns.weight || faces) && cells.size() != cells_of_first))
      file.refuse_line(line.offset, fmt::format("this row has {} numbers, the first row has {}; correct one of them",
                                                count_leading_numbers(cells), numbers));
  });
}

std::string fresh_xyz(const FreshCurve& curve, std::vector<std::string>& losses) {
  name_losses_of_rows(curve, losses);
  std::string text;
  append_rows(text, curve, ' ');
  return text;
}

}  // namespace vspring
