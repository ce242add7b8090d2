#include "io/table_rows.hpp"

#include <algorithm>
#include <string>

namespace vspring {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

TableLine::Kind kind_of(std::string_view text) {
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  if (first != text.end() && *first == '#') return TableLine::Kind::comment;
  const auto is_filling = [](char c) { return is_space(c) || c == ',' || c == ';'; };
  return std::all_of(first, text.end(), is_filling) ? TableLine::Kind::blank : TableLine::Kind::row;
}

}  // namespace

char line_end_of(std::string_view bytes) { return bytes.find('\n') == std::string_view::npos ? '\r' : '\n'; }

TableLine line_at(std::string_view bytes, std::size_t offset, char line_end) {
  std::string_view text = bytes.substr(offset, bytes.find(line_end, offset) - offset);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
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
    // Two quotes are one that belongs to the text.
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

std::optional<double> number_of(std::string_view cell) {
  double value = 0;
  const char* const end = cell.data() + cell.size();
  if (cell.empty() || parse_number(cell.data(), end, value) != end) return std::nullopt;
  return value;
}

bool has_decimal_comma(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos) return false;
  std::string pointed(cell);
  pointed[comma] = '.';
  return number_of(pointed).has_value();
}

}  // namespace vspring
