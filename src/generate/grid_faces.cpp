#include "generate/grid_faces.hpp"

namespace vspring::generate {

namespace {

enum class Piece {
  whole,
  cut,
  joined,  // with the next cell of the row
  taken    // by the cell before
};

Piece pattern(Faces faces, int column, int row) {
  switch (faces) {
    case Faces::triangles:
      return Piece::cut;
    case Faces::quads:
      return Piece::whole;
    case Faces::hexagons:
      return (column + row) % 2 == 0 ? Piece::joined : Piece::taken;
    case Faces::mixed: {
      // Shifted from row to row, so that in some row pairs lie whole within every four columns.
      constexpr Piece period[] = {Piece::joined, Piece::taken, Piece::whole, Piece::cut};
      return period[(column % 4 + row % 4) % 4];
    }
  }
  return Piece::whole;
}

/// The piece of a cell; pairs cut by an end of the row are single cells.
Piece piece_at(const Cells& cells, int column, int row) {
  const Piece piece = pattern(cells.faces, column, row);
  if (cells.around) return piece;
  const bool parted = (piece == Piece::taken && column == 0) || (piece == Piece::joined && column == cells.columns - 1);
  return parted ? Piece::whole : piece;
}

bool rising_diagonal(Faces faces, int column, int row) {
  // Cells that the mixed pattern cuts lie one column further left in each row.
  return faces == Faces::mixed ? ((column + row) / 4 + row) % 2 == 0 : (column + row) % 2 == 0;
}

}  // namespace

void add_grid_faces(MeshBuilder& builder, const Cells& cells, const std::function<Index(int column, int row)>& node) {
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      const Piece piece = piece_at(cells, column, row);
      if (piece == Piece::taken) continue;
      const Index a = node(column, row);
      const Index b = node(column + 1, row);
      const Index c = node(column + 1, row + 1);
      const Index d = node(column, row + 1);
      if (piece == Piece::joined) {
        builder.add_face({a, b, node(column + 2, row), node(column + 2, row + 1), c, d});
      } else if (piece == Piece::whole) {
        builder.add_face({a, b, c, d});
      } else if (rising_diagonal(cells.faces, column, row)) {
        builder.add_face({a, b, c});
        builder.add_face({a, c, d});
      } else {
        builder.add_face({a, b, d});
        builder.add_face({b, c, d});
      }
    }
  }
}

}  // namespace vspring::generate
