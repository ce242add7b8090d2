#include "generate/arguments.hpp"
#include "generate/cubes.hpp"
#include "generate/grid_faces.hpp"

namespace vspring::generate {

namespace {

/// Where the cubes of the block are.
struct Block {
  int holes;

  [[nodiscard]] bool filled(const LatticePoint& cube) const {
    if (cube[0] < 0 || cube[0] > 2 * holes || cube[1] < 0 || cube[1] > 2 || cube[2] != 0) return false;
    return cube[0] % 2 == 0 || cube[1] != 1;
  }
};

LatticePoint beside(LatticePoint cube, Side side) {
  cube[static_cast<std::size_t>(side) / 2] += static_cast<int>(side) % 2 == 0 ? 1 : -1;
  return cube;
}

}  // namespace

PolygonMesh genus(const GenusOptions& options) {
  require(options.holes >= 0 && options.holes <= 10000, "holes", "from 0 to 10000", options.holes);
  require(options.cells >= 1 && options.cells <= 100, "cells", "from 1 to 100", options.cells);
  require_length("side", options.side);
  require_node_count((18.0 * options.holes + 14) * options.cells * options.cells);

  const Block block{options.holes};
  const Vector3 middle = 0.5 * options.cells * Vector3(2 * options.holes + 1, 3, 1);
  MeshBuilder builder;
  LatticeNodes nodes(builder, [&](const LatticePoint& point) -> Vector3 {
    return options.side / options.cells * (Vector3(point[0], point[1], point[2]) - middle);
  });
  for (int x = 0; x <= 2 * options.holes; ++x) {
    for (int y = 0; y < 3; ++y) {
      const LatticePoint cube{x, y, 0};
      if (!block.filled(cube)) continue;
      for (int k = 0; k < 6; ++k) {
        const auto direction = static_cast<Side>(k);
        if (block.filled(beside(cube, direction))) continue;
        const CubeSide side(direction, {x * options.cells, y * options.cells, 0}, options.cells);
        add_grid_faces(builder, {options.cells, options.cells, Faces::quads},
                       [&](int column, int row) { return nodes.at(side.point(column, row)); });
      }
    }
  }
  return builder.take();
}

}  // namespace vspring::generate
