// Pipes that meet in a cube: each begins as a square side of the cube and ends as a circle.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/arguments.hpp"
#include "generate/cubes.hpp"
#include "generate/grid_faces.hpp"

namespace vspring::generate {

namespace {

constexpr int side_count = 6;

/// Rows of a pipe, even, so that one of them lies where the circle is reached.
int pipe_rows(const PipeBlendOptions& options) {
  return 2 * static_cast<int>(std::max(1.0, std::round(options.pipe_length * options.cells / options.side / 2)));
}

void check_pipe_blend(const PipeBlendOptions& options) {
  require(options.pipes.size() >= 2 && options.pipes.size() <= side_count, "number of pipes", "from 2 to 6",
          static_cast<double>(options.pipes.size()));
  for (auto pipe = options.pipes.begin(); pipe != options.pipes.end(); ++pipe) {
    const int side = static_cast<int>(*pipe);
    require(side >= 0 && side < side_count, "side", "one of the six sides of a cube", side);
    require(std::find(options.pipes.begin(), pipe, *pipe) == pipe, "pipes", "at different sides, each named once",
            side);
  }
  require(options.cells >= 1 && options.cells <= 10000, "cells", "from 1 to 10000", options.cells);
  require_length("side", options.side);
  require_length("pipe length", options.pipe_length);
  require_length("pipe radius", options.pipe_radius);
  require(options.pipe_radius <= options.side / 2, "pipe radius", "at most half the side of the cube",
          options.pipe_radius);
  require(options.faces == Faces::triangles || options.faces == Faces::quads, "faces", "quads or triangles",
          static_cast<int>(options.faces));
  const double cells = options.cells;
  require_node_count(6 * cells * cells + 24 * cells * std::max(2.0, options.pipe_length * cells / options.side + 2));
}

void add_pipe(MeshBuilder& builder, const PipeBlendOptions& options, const CubeSide& side, LatticeNodes& cube,
              const LatticeNodes::Place& place) {
  const int around = 4 * options.cells;
  const int rows = pipe_rows(options);
  std::vector<Index> nodes;
  nodes.reserve(static_cast<std::size_t>(around) * (rows + 1));
  for (int k = 0; k < around; ++k) nodes.push_back(cube.at(side.around(k)));
  for (int row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row) / rows;
    const double roundness = std::min(1.0, 2 * share);
    for (int k = 0; k < around; ++k) {
      // Corners of the square go to the circle's points at 45° to the sides.
      const double angle = std::numbers::pi * (2.0 * k / around - 0.75);
      const Vector3 circle = options.pipe_radius * std::cos(angle) * side.column_direction() +
                             options.pipe_radius * std::sin(angle) * side.row_direction() +
                             options.side / 2 * side.outward();
      const Vector3 section =
          roundness < 1 ? Vector3((1 - roundness) * place(side.around(k)) + roundness * circle) : circle;
      nodes.push_back(builder.add_node(section + share * options.pipe_length * side.outward()));
    }
  }
  add_grid_faces(builder, {around, rows, options.faces, true}, [&](int column, int row) {
    return nodes[static_cast<std::size_t>(row) * static_cast<std::size_t>(around) +
                 static_cast<std::size_t>(column % around)];
  });
}

}  // namespace

PolygonMesh pipe_blend(const PipeBlendOptions& options) {
  check_pipe_blend(options);
  const auto place = [&](const LatticePoint& point) -> Vector3 {
    const double middle = 0.5 * options.cells;
    return options.side / options.cells * Vector3(point[0] - middle, point[1] - middle, point[2] - middle);
  };
  MeshBuilder builder;
  LatticeNodes cube(builder, place);
  const auto has_pipe = [&](Side side) {
    return std::find(options.pipes.begin(), options.pipes.end(), side) != options.pipes.end();
  };
  for (int k = 0; k < side_count; ++k) {
    if (has_pipe(static_cast<Side>(k))) continue;
    const CubeSide side(static_cast<Side>(k), {0, 0, 0}, options.cells);
    add_grid_faces(builder, {options.cells, options.cells, options.faces},
                   [&](int column, int row) { return cube.at(side.point(column, row)); });
  }
  for (int k = 0; k < side_count; ++k) {
    if (!has_pipe(static_cast<Side>(k))) continue;
    add_pipe(builder, options, CubeSide(static_cast<Side>(k), {0, 0, 0}, options.cells), cube, place);
  }
  return builder.take();
}

}  // namespace vspring::generate
