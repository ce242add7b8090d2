#pragma once

#include <string>
#include <vector>

#include "terminal.hpp"
#include "vspring/figures.hpp"

namespace vspring::cli {

/// One shape's column of the table.
struct FigureColumn {
  std::string title;
  std::vector<Figure> figures;
};

/// Figures for people, a line each: name, a value for every column, unit, definition. The first column says which
/// figures there are; others stay empty where they lack one.
[[nodiscard]] std::string figure_table(const std::vector<FigureColumn>& columns, const Terminal& terminal);

}  // namespace vspring::cli
