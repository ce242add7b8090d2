#pragma once

#include <cstddef>
#include <vector>

#include "io/column_names.hpp"
#include "io/table.hpp"

namespace vspring {

/// The rows that a CSV file is known by.
std::vector<TableLine> first_rows(std::string_view bytes);

/// How many cells of a row are numbers.
std::size_t count_numbers(const Cells& cells, char decimal_mark);

/// How the rows of a CSV file are cut, and how its numbers are written: the delimiter that leaves two numbers in most
/// of its first rows, of several the first of ; tab , blank; and decimal commas where they leave more numbers than
/// points. Throws Error(unusable_file) for decimal commas between blanks.
CellCutter find_cutter(const InputFile& file, const std::vector<TableLine>& rows);

}  // namespace vspring
