#include "io/detect_curve_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/column_names.hpp"
#include "io/detect_format.hpp"
#include "io/table_rows.hpp"

namespace vspring {
namespace {

bool begins_with_numbers(const std::vector<std::string_view>& cells) {
  return cells.size() > 1 && number_of(cells[0]) && number_of(cells[1]);
}

bool names_x(const std::vector<std::string_view>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](std::string_view cell) { return cell == "x" || cell == "X"; });
}

}  // namespace

CurveFormat detect_curve_format(const InputFile& file) {
  if (const auto surface = detect_format(file.bytes)) {
    if (*surface == SurfaceFormat::obj) return CurveFormat::obj;
    file.refuse(fmt::format("its content is {}, which holds surfaces; use `vspring fair` for it", name_of(*surface)));
  }
  const std::vector<TableLine> lines = table_lines(file.bytes);
  const auto is_row = [](const TableLine& line) { return line.kind == TableLine::Kind::row; };
  const auto first = std::find_if(lines.begin(), lines.end(), is_row);
  if (first == lines.end()) file.refuse("no row of two or three numbers is in it; choose the file of a curve");
  CellCutter cutter(' ', true);
  const auto second = std::find_if(first + 1, lines.end(), is_row);
  const bool text_first = !begins_with_numbers(cutter.cut(first->text));
  // Names of columns are cut like the rows below them; the name of an aerofoil may hold anything.
  if (!text_first) return CurveFormat::xyz;
  const Cells& names = cutter.cut(first->text);
  if (names_x(names) || !find_coordinates(names).columns.empty() || second == lines.end()) return CurveFormat::csv;
  return begins_with_numbers(cutter.cut(second->text)) ? CurveFormat::dat : CurveFormat::csv;
}

}  // namespace vspring
