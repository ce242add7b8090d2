// Rows of two or three numbers and anything behind them, separated by white space.
#include <fmt/format.h>

#include <algorithm>

#include "io/table_source.hpp"

namespace vspring {
namespace {

std::size_t count_coordinates(const std::vector<std::string_view>& cells) {
  std::size_t count = 0;
  while (count < std::min<std::size_t>(cells.size(), 3) && number_of(cells[count])) ++count;
  return count;
}

}  // namespace

CurveFile read_xyz_curve(InputFile file) {
  const std::vector<TableLine> lines = table_lines(file.bytes);
  const auto is_row = [](const TableLine& line) { return line.kind == TableLine::Kind::row; };
  const auto first = std::find_if(lines.begin(), lines.end(), is_row);
  if (first == lines.end()) file.refuse("no row of two or three numbers is in it; choose the file of a curve");
  CellCutter cutter(' ', false);
  const std::size_t count = count_coordinates(cutter.cut(first->text));
  TableReader reader(file, cutter, count == 3 ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0, 1});
  // Of a planar curve and one in space mixed, one of the two would be misread.
  for (const TableLine& line : lines) {
    if (count != 2 || !is_row(line) || count_coordinates(cutter.cut(line.text)) < 3) continue;
    file.refuse_line(line.offset, "this row has three numbers, the first row has two; correct one of them");
  }
  reader.read(lines);
  return reader.take(std::move(file), CurveFormat::xyz);
}

}  // namespace vspring
