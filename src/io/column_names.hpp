#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/column_choice.hpp"

namespace vspring {

/// The cells of a row.
using Cells = std::vector<std::string_view>;

/// What a header says of coordinates.
struct NamedCoordinates {
  std::vector<std::size_t> columns;  ///< of two or three, in the order of their names; or none
  std::string remark;                ///< where these are not x and y, or x, y and z; else empty
  std::string doubt;                 ///< where two columns have the same name but for their units; else empty
};

/// Finds columns named x, y and z, in any case: alone, with a unit in brackets or behind a blank, an underscore or a
/// hyphen ("X [mm]", "y_m", "Z-coordinate (in)"), or as a ratio ("x/c"). Without x, "station" is one. "Points:0" to
/// "Points:2", as ParaView names them, are coordinates too. A name alone goes before one with a unit.
NamedCoordinates find_coordinates(const Cells& header);

/// The columns of longitude and latitude, in this order: those with such a name, in any case, alone or with a unit of
/// degrees ("lat", "Longitude [deg]", "lng"); nothing unless there are both.
std::optional<std::array<std::size_t, 2>> find_degrees(const Cells& header);

/// The column that is called so, in any case, or the number of cells.
std::size_t column_named(const Cells& header, std::string_view name);

/// The column of that name, alone or with a unit and in any case, or the number of cells.
std::size_t column_like(const Cells& header, std::string_view name);

/// The columns that were chosen, from 0. first: the file's first row, at an offset, for names. Throws
/// Error(invalid_argument) where the choice is none, and Error(unusable_file) where no column has a name.
std::vector<std::size_t> chosen_columns(const InputFile& file, const Cells& first, std::size_t offset,
                                        const ColumnChoice& choice);

/// Whether elevations are chosen of a track, besides longitude and latitude. Throws Error(invalid_argument) for other
/// columns.
bool chooses_elevations(const InputFile& file, const ColumnChoice& choice);

/// Throws Error(invalid_argument) where columns are chosen of a file that is no table.
void refuse_choice(const InputFile& file, const ColumnChoice& choice);

/// Throws Error(unusable_file) where a row is too short for the columns that were chosen.
void require_columns(const InputFile& file, const Cells& row, std::size_t offset,
                     const std::vector<std::size_t>& columns);

}  // namespace vspring
