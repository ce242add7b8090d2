#pragma once

#include <string>
#include <vector>

namespace vspring {

/// The columns of a table (CSV, XYZ) in which x, y and, in space, z stand, in this order: of each its number, from 1,
/// or, in CSV, the name that the header gives it, with or without its unit, in any case. Two or three of them; empty:
/// the reader finds them.
using ColumnChoice = std::vector<std::string>;

}  // namespace vspring
