// A planing hull with two chines.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "generate/arguments.hpp"
#include "generate/grid_faces.hpp"

namespace vspring::generate {

namespace {

/// A line along the hull, from the transom to the stem; in lengths of the hull and in half beams.
struct LongLine {
  double end;         ///< where it meets the stem
  double breadth;     ///< from the middle to the line, at the transom
  double height;      ///< at the transom
  double rise;        ///< from there to the stem
  double rise_power;  ///< of the share of the way: large where it rises near the stem only
};

// Keel, inner chine, outer chine, deck edge.
constexpr std::array<LongLine, 4> lines = {
    {{0.86, 0, -0.36, 0.3, 4}, {0.92, 0.66, -0.19, 0.37, 3}, {0.955, 0.84, -0.01, 0.43, 2.5}, {1, 1, 0.6, 0.26, 1}}};
// The power of the share of the way by which breadth falls: the larger, the fuller the bow.
constexpr double fullness = 2.6;

/// share: 0 at the transom, 1 at the stem.
Vector3 place_on(const LongLine& line, double share, const HullOptions& options) {
  const double half = options.beam / 2;
  return {options.length * line.end * share, half * line.breadth * (1 - std::pow(share, fullness)),
          half * (line.height + line.rise * std::pow(share, line.rise_power))};
}

}  // namespace

PolygonMesh hull(const HullOptions& options) {
  require(options.columns >= 4 && options.columns <= 100'000, "columns", "from 4 to 100000", options.columns);
  require(options.rows >= 3 && options.rows <= 100'000 && options.rows % 3 == 0, "rows",
          "a multiple of 3 from 3 to 100000", options.rows);
  require_length("length", options.length);
  require_length("beam", options.beam);
  require(options.faces == Faces::triangles || options.faces == Faces::quads, "faces", "quads or triangles",
          static_cast<int>(options.faces));
  const int across = options.columns + 1;
  require_node_count((options.whole ? 2.0 : 1.0) * across * (options.rows + 1));
  const int per_strake = options.rows / 3;
  MeshBuilder builder;
  std::vector<Vector3> places;
  for (int row = 0; row <= options.rows; ++row) {
    const auto strake = static_cast<std::size_t>(std::min(row / per_strake, 2));
    const double up = static_cast<double>(row - static_cast<int>(strake) * per_strake) / per_strake;
    for (int column = 0; column < across; ++column) {
      const double share = static_cast<double>(column) / options.columns;
      places.push_back((1 - up) * place_on(lines[strake], share, options) +
                       up * place_on(lines[strake + 1], share, options));
      builder.add_node(places.back());
    }
  }
  const auto node = [&](int column, int row) { return static_cast<Index>(row * across + column); };
  const Cells cells{options.columns, options.rows, options.faces};
  // Rows run up and columns aft, so that faces look to port.
  add_grid_faces(builder, cells, [&](int column, int row) { return node(options.columns - column, row); });
  if (options.whole) {
    std::vector<Index> images(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      images[i] =
          places[i].y() == 0 ? static_cast<Index>(i) : builder.add_node({places[i].x(), -places[i].y(), places[i].z()});
    add_grid_faces(builder, cells,
                   [&](int column, int row) { return images[static_cast<std::size_t>(node(column, row))]; });
  }
  return builder.take();
}

}  // namespace vspring::generate
