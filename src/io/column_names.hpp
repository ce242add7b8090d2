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

/// The coordinates that a header names.
struct NamedCoordinates {
  std::vector<std::size_t> columns;  ///< two or three, in the order of their names; or none
  std::string remark;                ///< set if they are not x and y, or x, y and z
  std::string doubt;                 ///< set if two names differ only in their units
};

/// Finds columns named x, y and z, in any case: alone, with a unit in brackets or behind a blank, an underscore or a
/// hyphen ("X [mm]", "y_m", "Z-coordinate (in)"), or as a ratio ("x/c"). Without x, "station" counts as x. "Points:0"
/// to "Points:2", as ParaView names them, are coordinates too. A name alone has precedence over one with a unit.
NamedCoordinates find_coordinates(const Cells& header);

/// The columns of longitude and latitude, in this order: named so in any case, alone or with a unit of degrees ("lat",
/// "Longitude [deg]", "lng"); nothing unless there are both.
std::optional<std::array<std::size_t, 2>> find_degrees(const Cells& header);

/// The column of exactly that name, in any case, or the number of cells.
std::size_t column_named(const Cells& header, std::string_view name);

/// The column of that name, alone or with a unit, in any case, or the number of cells.
std::size_t column_like(const Cells& header, std::string_view name);

/// The chosen columns, from 0. first: the file's first row, at an offset, for names. Throws Error(invalid_argument) for
/// an invalid choice, and Error(unusable_file) for a name that no column has.
std::vector<std::size_t> chosen_columns(const InputFile& file, const Cells& first, std::size_t offset,
                                        const ColumnChoice& choice);

/// Whether a choice of columns of a track has elevations besides longitude and latitude. Throws Error(invalid_argument)
/// for other columns.
bool chooses_elevations(const InputFile& file, const ColumnChoice& choice);

/// Throws Error(invalid_argument) if columns are chosen for a file that is no table.
void refuse_choice(const InputFile& file, const ColumnChoice& choice);

/// Throws Error(unusable_file) if a row is too short for the chosen columns.
void require_columns(const InputFile& file, const Cells& row, std::size_t offset,
                     const std::vector<std::size_t>& columns);

}  // namespace vspring
