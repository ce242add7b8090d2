#pragma once

#include <functional>

#include "vspring/generate.hpp"

namespace vspring::generate {

/// Cells of a grid that are to become faces.
struct Cells {
  int columns;
  int rows;
  Faces faces;
  bool around = false;  ///< the last column is followed by the first
};

/// Adds the faces of a grid, row by row. node: the node at the lower left corner of the cell (column, row), asked for
/// columns from 0 to `columns` (twice that many around) and rows from 0 to `rows`. Faces run from columns to rows.
void add_grid_faces(MeshBuilder& builder, const Cells& cells, const std::function<Index(int column, int row)>& node);

}  // namespace vspring::generate
