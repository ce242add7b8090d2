// Rows of cells, for CSV, XYZ and DAT.
#include "io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/message_text.hpp"
#include "io/degrees.hpp"
#include "io/face_list.hpp"
#include "io/rewriter.hpp"

namespace vspring {
namespace {

/// The names of columns in messages.
using ColumnNames = std::array<const char*, 3>;
constexpr ColumnNames coordinate_names = {"x", "y", "z"};
constexpr ColumnNames degree_names = {"the longitude", "the latitude", "z"};
constexpr ColumnNames normal_names = {"nx", "ny", "nz"};

TableLine::Kind kind_of(std::string_view text) {
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  if (first != text.end() && *first == '#') return TableLine::Kind::comment;
  const auto is_filling = [](char c) { return is_space(c) || c == ',' || c == ';'; };
  return std::all_of(first, text.end(), is_filling) ? TableLine::Kind::blank : TableLine::Kind::row;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

char line_end_of(std::string_view bytes) { return bytes.find('\n') == std::string_view::npos ? '\r' : '\n'; }

TableLine line_at(std::string_view bytes, std::size_t offset, char line_end) {
  // DOS marked the end of texts by it.
  constexpr char end_of_text = '\x1a';
  std::string_view text = bytes.substr(offset, bytes.find(line_end, offset) - offset);
  while (!text.empty() && (is_space(text.back()) || text.back() == end_of_text)) text.remove_suffix(1);
  return {.text = text, .offset = offset, .kind = kind_of(text)};
}

std::vector<TableLine> table_lines(std::string_view bytes) {
  std::vector<TableLine> lines;
  lines.reserve(static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), line_end_of(bytes))) + 1);
  walk_lines(bytes, [&](const TableLine& line) {
    lines.push_back(line);
    return true;
  });
  return lines;
}

bool CellCutter::is_delimiter(char c) const { return delimiter_ == ' ' ? is_space(c) : c == delimiter_; }

std::size_t CellCutter::cell_end(std::string_view row, std::size_t begin) const {
  std::size_t at = begin;
  if (quotes_ && row.substr(at).starts_with('"')) {
    std::size_t close = row.find('"', at + 1);
    // Two quotes stand for one in the text.
    while (close != std::string_view::npos && row.substr(close + 1).starts_with('"')) close = row.find('"', close + 2);
    if (close != std::string_view::npos) at = close + 1;
  }
  while (at < row.size() && !is_delimiter(row[at])) ++at;
  return at;
}

const std::vector<std::string_view>& CellCutter::cut(std::string_view row) {
  cells_.clear();
  for (std::size_t at = 0;; ++at) {
    while (at < row.size() && is_space(row[at]) && (delimiter_ == ' ' || !is_delimiter(row[at]))) ++at;
    if (delimiter_ == ' ' && at == row.size()) return cells_;
    const std::size_t end = cell_end(row, at);
    std::string_view cell = trimmed(row.substr(at, end - at));
    if (quotes_ && cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = trimmed(cell.substr(1, cell.size() - 2));
    cells_.push_back(cell);
    if (end == row.size()) return cells_;
    at = end;
  }
}

std::optional<double> number_of(std::string_view cell, char decimal_mark) {
  double value = 0;
  const char* const end = cell.data() + cell.size();
  if (cell.empty() || parse_number(cell.data(), end, value, decimal_mark) != end) return std::nullopt;
  return value;
}

bool has_decimal_comma(std::string_view cell) {
  return cell.find(',') != std::string_view::npos && number_of(cell, ',').has_value();
}

Vector3 TableSource::numbers_at(const Vector3& position) const {
  if (!plane) return position;
  const LocalPlane::Place place = plane->place(position);
  return {place.longitude < 0 && counts_to_360 ? place.longitude + 360 : place.longitude, place.latitude, position.z()};
}

std::string_view TableSource::text_of(const Row& row) const {
  return line_at(file.bytes, row.offset, line_end_of(file.bytes)).text;
}

std::string TableSource::with_numbers(std::string_view row, std::size_t node, const Vector3& place,
                                      const std::vector<std::size_t>& by_place) const {
  const Vector3 numbers = numbers_at(place);
  const auto stays = [&](Eigen::Index k) {
    const Vector3& before = positions[node];
    return plane && k < 2 ? before.head<2>() == place.head<2>() : before[k] == place[k];
  };
  CellCutter knife = cutter;
  const std::vector<std::string_view>& cells = knife.cut(row);
  TextRewriter out(row);
  std::string number;
  for (const std::size_t k : by_place) {
    if (stays(static_cast<Eigen::Index>(k))) continue;
    const std::string_view cell = cells[columns[k]];
    const auto begin = static_cast<std::size_t>(cell.data() - row.data());
    number.clear();
    if (plane && k < 2)
      append_degrees(number, numbers[static_cast<Eigen::Index>(k)]);
    else
      append_number(number, numbers[static_cast<Eigen::Index>(k)]);
    std::replace(number.begin(), number.end(), '.', cutter.decimal_mark());
    out.replace(begin, begin + cell.size(), number);
  }
  return out.finish();
}

std::string TableSource::rewritten(const Rewriting& what) const {
  TextRewriter out(file.bytes);
  // Columns may have any order, but places in the file must ascend.
  std::vector<std::size_t> by_place(columns.size());
  std::iota(by_place.begin(), by_place.end(), std::size_t{0});
  std::sort(by_place.begin(), by_place.end(), [&](std::size_t a, std::size_t b) { return columns[a] < columns[b]; });
  for (std::size_t slot = 0; slot < rows.size(); ++slot) {
    // If the order changed, every node has one row.
    const std::size_t from = what.node_in(slot);
    const auto node = static_cast<std::size_t>(rows[from].node);
    if (from == slot && what.moved[node] == 0) continue;
    const std::string_view text = text_of(rows[from]);
    const std::size_t begin = rows[slot].offset;
    const std::size_t end = begin + text_of(rows[slot]).size();
    if (what.moved[node] != 0)
      out.replace(begin, end, with_numbers(text, node, what.places[node], by_place));
    else
      out.replace(begin, end, text);
  }
  return out.finish();
}

double number_in(const InputFile& file, const TableLine& line, std::span<const std::string_view> cells,
                 std::size_t column, std::string_view name, char decimal_mark) {
  if (column >= cells.size()) {
    const bool at_end = line.offset + line.text.size() == file.bytes.size();
    file.refuse_line(line.offset, at_end ? fmt::format("the file ends where {} belongs; it is cut off", name)
                                         : fmt::format("the line ends where {} belongs; repair the line", name));
  }
  const std::string_view cell = cells[column];
  if (const std::optional<double> value = number_of(cell, decimal_mark)) return *value;
  const char* advice = "repair the line";
  if (decimal_mark == '.' && has_decimal_comma(cell)) advice = "write decimal points, not commas";
  if (decimal_mark == ',' && number_of(cell)) advice = "write a decimal comma, as other rows do";
  file.refuse_line(line.offset, fmt::format("{} stands where {} belongs; {}",
                                            cell.empty() ? "nothing" : in_quotes(cell), name, advice));
}

TableReader::TableReader(const InputFile& file, CellCutter cutter, std::vector<std::size_t> columns, bool degrees)
    : file_(file), degrees_(degrees) {
  source_->cutter = std::move(cutter);
  source_->columns = std::move(columns);
}

void TableReader::read(std::span<const TableLine> lines) {
  source_->has_rows = true;
  bool open = false;
  for (const TableLine& line : lines) {
    if (line.kind == TableLine::Kind::comment) carry("comments");
    if (line.kind == TableLine::Kind::blank) open = false;
    if (line.kind != TableLine::Kind::row) continue;
    const Vector3 position = position_in(line);
    if (open && position == positions().back()) repeats_.push_back(line.offset);
    if (!open) chains.emplace_back();
    open = true;
    chains.back().nodes.push_back(static_cast<Index>(positions().size()));
    add_node(line, position);
  }
}

Vector3 TableReader::position_in(const TableLine& line) {
  const std::vector<std::string_view>& cells = source_->cutter.cut(line.text);
  const ColumnNames& names = degrees_ ? degree_names : coordinate_names;
  Vector3 position = Vector3::Zero();
  for (std::size_t k = 0; k < source_->columns.size(); ++k)
    position[static_cast<Eigen::Index>(k)] =
        number_in(file_, line, cells, source_->columns[k], names[k], source_->cutter.decimal_mark());
  if (degrees_) {
    require_place(file_, line.offset, {position.y(), position.x()});
    source_->counts_to_360 = source_->counts_to_360 || position.x() > 180;
  }
  if (cells.size() > source_->columns.size()) carry("other columns");
  return position;
}

void TableReader::add_node(const TableLine& line, const Vector3& position) {
  if (static_cast<std::int64_t>(positions().size()) == most_nodes)
    file_.refuse_line(line.offset, "more than 2^30 nodes; split the file");
  add_row(line, static_cast<Index>(positions().size()));
  source_->positions.push_back(position);
}

CurveFile TableReader::take(InputFile file, CurveFormat format, const std::optional<LocalPlane>& plane) {
  if (positions().empty()) file.refuse("no row of two or three numbers is in it; choose the file of a curve");
  if (std::none_of(chains.begin(), chains.end(), [](const auto& chain) { return chain.nodes.size() > 1; }))
    file.refuse("no two of its nodes follow each other; choose the file of a curve");
  CurveFile curve;
  curve.format = format;
  curve.planar = source_->columns.size() == 2;
  if (degrees_) {
    curve.plane = source_->plane = take_to_plane(source_->positions, plane);
    const std::string warning = stretch_warning(file, *curve.plane, source_->positions);
    if (!warning.empty()) curve.warnings.push_back(warning);
  }
  if (!repeats_.empty())
    curve.warnings.push_back(
        fmt::format("{}:{}: this row is at the same place as the one above{}; leave it out unless it is meant",
                    file.name, file.line_of(repeats_.front()),
                    repeats_.size() > 1 ? fmt::format(", and so are {} more below", repeats_.size() - 1) : ""));
  curve.curve = PolygonCurve(source_->positions, std::move(chains));
  source_->carried.assign(carried_.begin(), carried_.end());
  source_->file = std::move(file);
  curve.source = std::move(source_);
  return curve;
}

ScatteredPoints read_point_rows(const InputFile& file, CellCutter cutter, const PointColumns& columns,
                                std::size_t behind, const RowCheck& check, const std::optional<LocalPlane>& plane) {
  ScatteredPoints points;
  // Reserved memory that stays unused is never touched.
  const auto lines =
      static_cast<std::size_t>(std::count(file.bytes.begin(), file.bytes.end(), line_end_of(file.bytes))) + 1;
  points.positions.reserve(lines);
  if (columns.weight) points.weights.reserve(lines);
  if (!columns.normal.empty()) points.normals.reserve(lines);
  walk_lines(file.bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row || line.offset < behind) return true;
    if (static_cast<std::int64_t>(points.positions.size()) == most_nodes)
      file.refuse_line(line.offset, "more than 2^30 points; split the file");
    const std::vector<std::string_view>& cells = cutter.cut(line.text);
    if (check) check(line, cells);
    const auto vector_in = [&](const std::vector<std::size_t>& of, const ColumnNames& named) {
      Vector3 vector = Vector3::Zero();
      for (std::size_t k = 0; k < of.size(); ++k)
        vector[static_cast<Eigen::Index>(k)] = number_in(file, line, cells, of[k], named[k], cutter.decimal_mark());
      return vector;
    };
    const Vector3 position = vector_in(columns.coordinates, columns.degrees ? degree_names : coordinate_names);
    if (columns.degrees) require_place(file, line.offset, {position.y(), position.x()});
    points.positions.push_back(position);
    if (!columns.normal.empty()) points.normals.push_back(vector_in(columns.normal, normal_names));
    if (!columns.weight) return true;
    const double weight =
        points.weights.emplace_back(number_in(file, line, cells, *columns.weight, "the weight", cutter.decimal_mark()));
    if (!is_point_weight(weight))
      file.refuse_line(line.offset, fmt::format("the weight is {}; give 0 or more", weight));
    return true;
  });
  if (columns.degrees && !points.positions.empty()) points.plane = take_to_plane(points.positions, plane);
  return points;
}

void append_rows(std::string& text, const FreshCurve& curve, char between) {
  text.reserve(text.size() + 60 * curve.positions.size());
  const auto append_row = [&](const Vector3& position) {
    append_numbers(text, position, curve.planar ? 2 : 3, between);
    text += '\n';
  };
  walk_rows(curve, append_row, [&] { text += '\n'; });
}

void name_losses_of_rows(const FreshCurve& curve, std::vector<std::string>& losses) {
  std::vector<std::uint8_t> uses(curve.positions.size(), 0);
  bool shared = false;
  bool closed = false;
  for (const PolygonCurve::Chain& chain : curve.chains) {
    closed = closed || chain.closed;
    for (const Index node : chain.nodes) {
      std::uint8_t& use = uses[static_cast<std::size_t>(node)];
      shared = shared || use != 0;
      use = 1;
    }
  }
  if (closed) losses.emplace_back("that chains are closed: their first node is written again at their end");
  if (shared) losses.emplace_back("that chains share nodes: these are written once for each");
  if (std::find(uses.begin(), uses.end(), 0) != uses.end()) losses.emplace_back("nodes that no chain uses");
}

}  // namespace vspring
