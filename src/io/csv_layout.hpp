#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/column_names.hpp"
#include "io/input_file.hpp"
#include "io/table_rows.hpp"

namespace vspring {

/// How the rows of a CSV file are to be read.
struct CsvLayout {
  CellCutter cutter;
  std::vector<std::size_t> columns;   ///< of x, y and, in space, z
  std::optional<std::size_t> header;  ///< offset of the row that names columns, or of one of units below it
  std::optional<std::size_t> weight;  ///< column that the header names weight or, without one, confidence
  std::vector<std::size_t> normal;    ///< columns that the header names nx, ny and nz; or none
  std::string warning;                ///< of columns that had to be guessed; empty without
};

/// Finds the delimiter and the columns of coordinates: those that are chosen, else those that a header names, see
/// find_coordinates(), else the first ones of numbers, where these can be told from others. Throws
/// Error(unusable_file), and Error(invalid_argument) for a choice that is none.
CsvLayout find_csv_layout(const InputFile& file, const ColumnChoice& choice);

}  // namespace vspring
