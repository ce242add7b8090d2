#include "io/table_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "base/message_text.hpp"
#include "io/face_list.hpp"
#include "io/text_rewriter.hpp"

namespace vspring {

std::string TableSource::rewritten(const std::vector<Vector3>& places, const std::vector<std::uint8_t>& moved) const {
  TextRewriter out(file.bytes);
  const char line_end = line_end_of(file.bytes);
  CellCutter knife = cutter;
  // Columns may stand in any order, places in the file have to ascend.
  std::vector<std::size_t> order(columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return columns[a] < columns[b]; });
  std::string number;
  for (const Row& row : rows) {
    const auto node = static_cast<std::size_t>(row.node);
    if (moved[node] == 0) continue;
    const std::vector<std::string_view>& cells = knife.cut(line_at(file.bytes, row.offset, line_end).text);
    for (const std::size_t k : order) {
      const std::string_view cell = cells[columns[k]];
      const auto begin = static_cast<std::size_t>(cell.data() - file.bytes.data());
      number.clear();
      append_number(number, places[node][static_cast<Eigen::Index>(k)]);
      out.replace(begin, begin + cell.size(), number);
    }
  }
  return out.finish();
}

double number_in(const InputFile& file, const TableLine& line, std::span<const std::string_view> cells,
                 std::size_t column, std::string_view name) {
  if (column >= cells.size()) {
    const bool at_end = line.offset + line.text.size() == file.bytes.size();
    file.refuse_line(line.offset, at_end ? fmt::format("the file ends where {} belongs; it is cut off", name)
                                         : fmt::format("the line ends where {} belongs; repair the line", name));
  }
  const std::string_view cell = cells[column];
  if (const std::optional<double> value = number_of(cell)) return *value;
  file.refuse_line(line.offset,
                   fmt::format("{} stands where {} belongs; {}", cell.empty() ? "nothing" : in_quotes(cell), name,
                               has_decimal_comma(cell) ? "write decimal points, not commas" : "repair the line"));
}

TableReader::TableReader(const InputFile& file, CellCutter cutter, std::vector<std::size_t> columns) : file_(file) {
  source_->cutter = std::move(cutter);
  source_->columns = std::move(columns);
}

void TableReader::read(std::span<const TableLine> lines) {
  bool open = false;
  for (const TableLine& line : lines) {
    if (line.kind == TableLine::Kind::comment) carry("comments");
    if (line.kind == TableLine::Kind::blank) open = false;
    if (line.kind != TableLine::Kind::row) continue;
    if (!open) chains.emplace_back();
    open = true;
    chains.back().nodes.push_back(static_cast<Index>(positions().size()));
    add_node(line, position_in(line));
  }
}

Vector3 TableReader::position_in(const TableLine& line) {
  const std::vector<std::string_view>& cells = source_->cutter.cut(line.text);
  constexpr std::array names = {"x", "y", "z"};
  Vector3 position = Vector3::Zero();
  for (std::size_t k = 0; k < source_->columns.size(); ++k)
    position[static_cast<Eigen::Index>(k)] = number_in(file_, line, cells, source_->columns[k], names[k]);
  if (cells.size() > source_->columns.size()) carry("other columns");
  return position;
}

void TableReader::add_node(const TableLine& line, const Vector3& position) {
  if (static_cast<std::int64_t>(positions().size()) == most_nodes)
    file_.refuse_line(line.offset, "more than 2^30 nodes; split the file");
  add_row(line, static_cast<Index>(positions().size()));
  source_->positions.push_back(position);
}

CurveFile TableReader::take(InputFile file, CurveFormat format) {
  if (positions().empty()) file.refuse("no row of two or three numbers is in it; choose the file of a curve");
  if (std::none_of(chains.begin(), chains.end(), [](const auto& chain) { return chain.nodes.size() > 1; }))
    file.refuse("no two of its nodes follow each other; choose the file of a curve");
  CurveFile curve;
  curve.format = format;
  curve.planar = source_->columns.size() == 2;
  curve.curve = PolygonCurve(source_->positions, std::move(chains));
  source_->carried.assign(carried_.begin(), carried_.end());
  source_->file = std::move(file);
  curve.source = std::move(source_);
  return curve;
}

}  // namespace vspring
