#pragma once

#include <functional>

#include "vspring/generate.hpp"

namespace vspring::generate {

/// Cells of a grid to be made faces.
struct Cells {
  int columns;
  int rows;
  Faces faces;
  bool around = false;  ///< the last column is followed by the first
};

/// Adds the faces of a grid, row by row. node: gives the node at the lower left corner of the cell (column, row), for
/// columns 0 to `columns` (twice that many around) and rows 0 to `rows`. Faces run from the direction of columns to
/// that of rows.
void add_grid_faces(MeshBuilder& builder, const Cells& cells, const std::function<Index(int column, int row)>& node);

}  // namespace vspring::generate
