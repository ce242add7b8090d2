#pragma once

#include <string>
#include <vector>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// The columns of a table (CSV, XYZ) that hold x, y and, in space, z, in this order: each by its number from 1 or, in
/// CSV, by its name in the header, with or without its unit, in any case. Two or three entries; empty: the reader finds
/// the columns. GPX: lon and lat, or these and ele.
using ColumnChoice = std::vector<std::string>;

}  // namespace vspring
