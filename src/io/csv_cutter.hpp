#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "io/column_names.hpp"
#include "io/table.hpp"

namespace vspring {

/// The first rows of a CSV file, from which its layout is found.
std::vector<TableLine> first_rows(std::string_view bytes);

/// How many cells of a row are numbers.
std::size_t count_numbers(const Cells& cells, char decimal_mark);

/// Finds how to cut the rows of a CSV file, and its decimal mark. The delimiter is the one that leaves two numbers in
/// most of the first rows, in doubt the first of ; tab , blank. Numbers have decimal commas if that reads more of them
/// than points. Throws Error(unusable_file) for decimal commas between blanks.
CellCutter find_cutter(const InputFile& file, const std::vector<TableLine>& rows);

/// Throws Error(unusable_file) if commas seem to stand both in numbers and between them. rows: below the header. names:
/// how many cells that has; 0 without one.
void refuse_commas_in_numbers(const InputFile& file, CellCutter cutter, std::span<const TableLine> rows,
                              std::size_t names);

/// Throws Error(unusable_file) naming a line that ends within quotes. Cost: linear; little without quotes.
void refuse_cells_of_several_lines(const InputFile& file, CellCutter cutter);

}  // namespace vspring
