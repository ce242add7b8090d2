// Finds what separates the cells of CSV, and whether its numbers have decimal points or commas.
#include "io/csv_cutter.hpp"

#include <algorithm>
#include <array>
#include <string>

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

}  // namespace vspring
