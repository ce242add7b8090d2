// One node per row of a table with a header or without.
#include "io/csv_layout.hpp"
#include "io/table_source.hpp"

namespace vspring {

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

}  // namespace vspring
