// Finds what separates the cells of CSV, and whether its numbers have decimal points or commas.
#include "io/csv_cutter.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace vspring {
namespace {

/// "1,5;2,5" cut at its commas leaves "5;2" in the middle.
bool is_two_numbers(std::string_view cell) {
  return std::any_of(cell.begin(), cell.end(), [&](const char& c) {
    const auto at = static_cast<std::size_t>(&c - cell.data());
    return (c == ';' || c == '\t' || c == ' ') && number_of(cell.substr(0, at)) && number_of(cell.substr(at + 1));
  });
}

constexpr std::array delimiters = {';', '\t', ',', ' '};

/// A pair of delimiter and decimal mark, and how well it fits the rows.
struct TriedCutter {
  CellCutter cutter;
  std::size_t numbers = 0;
  std::size_t fitting = 0;  ///< rows of two numbers or more
};

TriedCutter try_cutter(const std::vector<TableLine>& rows, char delimiter, char decimal_mark) {
  TriedCutter tried{{delimiter, true, decimal_mark}};
  for (const TableLine& row : rows) {
    const Cells& cells = tried.cutter.cut(row.text);
    if (delimiter == ',' && std::any_of(cells.begin(), cells.end(), is_two_numbers)) continue;
    const std::size_t numbers = count_numbers(cells, decimal_mark);
    tried.numbers += numbers;
    if (numbers > 1) ++tried.fitting;
  }
  return tried;
}

/// Whether decimals have commas, by the first number that allows one decimal mark only. The first rows of a table may
/// hold whole numbers only.
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

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_whole_number(std::string_view cell) {
  if (cell.starts_with('-') || cell.starts_with('+')) cell.remove_prefix(1);
  return !cell.empty() && std::all_of(cell.begin(), cell.end(), is_digit);
}

/// As the decimals of "0,05" do, but no whole number.
bool begins_with_zeros(std::string_view cell) { return cell.size() > 1 && cell.front() == '0'; }

}  // namespace

std::vector<TableLine> first_rows(std::string_view bytes) {
  constexpr std::size_t rows_looked_at = 20;
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
  // With blanks as delimiters, which commas are decimal ones would be a guess.
  for (const TableLine& row : rows) {
    if (best.fitting > 0) break;
    const Cells& cells = best.cutter.cut(row.text);
    if (std::any_of(cells.begin(), cells.end(), has_decimal_comma))
      file.refuse_line(row.offset,
                       "its numbers have decimal commas, and blanks between them; write decimal points, or "
                       "semicolons in place of the blanks");
  }
  const bool may_have_commas =
      cuts == ';' || cuts == '\t' || (cuts == ',' && file.bytes.find('"') != std::string::npos);
  if (whole && may_have_commas && has_commas_below(file.bytes, best.cutter)) return {cuts, true, ','};
  return best.cutter;
}

void refuse_commas_in_numbers(const InputFile& file, CellCutter cutter, std::span<const TableLine> rows,
                              std::size_t names) {
  if (!cutter.cuts_at_commas() || cutter.decimal_mark() != '.') return;
  std::size_t most = 0;
  bool has_decimals = false;
  for (const TableLine& row : rows) {
    const Cells& cells = cutter.cut(row.text);
    if (!std::all_of(cells.begin(), cells.end(), is_whole_number)) return;
    most = std::max(most, cells.size());
    has_decimals = has_decimals || std::any_of(cells.begin() + 1, cells.end(), begins_with_zeros);
  }
  if (names > 0 ? most != 2 * names : !has_decimals) return;
  file.refuse_line(rows.front().offset, "its numbers seem to have decimal commas, and commas stand between them, too",
                   {{Remedy::input, "write decimal points"},
                    {Remedy::input, "separate the numbers by semicolons"},
                    {Remedy::columns, "choose columns by number if all numbers are whole"}});
}

void refuse_cells_of_several_lines(const InputFile& file, CellCutter cutter) {
  if (file.bytes.find('"') == std::string::npos) return;
  walk_lines(file.bytes, [&](const TableLine& line) {
    if (line.kind != TableLine::Kind::row) return true;
    if (std::count(line.text.begin(), line.text.end(), '"') % 2 == 0) return true;
    const std::string_view last = cutter.cut(line.text).back();
    if (last.size() < 2 || last.front() != '"') return true;
    const std::size_t begin = line.offset + line.text.size();
    const std::size_t close = file.bytes.find('"', begin);
    if (close == std::string::npos) return true;
    const char next = close + 1 < file.bytes.size() ? file.bytes[close + 1] : '\n';
    if (next == ',' || next == ';' || is_space(next))
      file.refuse_line(line.offset, "a cell in quotes goes on in the next line; write it in one line");
    return true;
  });
}

}  // namespace vspring
