// Rows of two or three numbers and anything behind them, separated by white space.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/column_names.hpp"
#include "io/table_source.hpp"

namespace vspring {
namespace {

std::size_t count_coordinates(const std::vector<std::string_view>& cells) {
  std::size_t count = 0;
  while (count < std::min<std::size_t>(cells.size(), 3) && number_of(cells[count])) ++count;
  return count;
}

}  // namespace

CurveFile read_xyz_curve(InputFile file, const ColumnChoice& choice) {
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
  // Of a planar curve and one in space mixed, one of the two would be misread.
  for (const TableLine& line : lines) {
    if (!choice.empty() || count != 2 || !is_row(line) || count_coordinates(cutter.cut(line.text)) < 3) continue;
    file.refuse_line(line.offset, "this row has three numbers, the first row has two; correct one of them");
  }
  reader.read(lines);
  return reader.take(std::move(file), CurveFormat::xyz);
}

}  // namespace vspring
