#include "generate/arguments.hpp"

#include <fmt/format.h>

#include "vspring/error.hpp"

namespace vspring::generate {

namespace {

constexpr double least_length = 1e-100;
constexpr double greatest_length = 1e100;
constexpr double most_nodes = 1e8;

void require_cells(std::string_view name, int value, Faces faces, bool wrapped) {
  if (!wrapped) {
    require(value >= 1, name, "1 or more", value);
  } else if (faces == Faces::mixed) {
    require(value >= 4 && value % 4 == 0, name, "a multiple of 4, for mixed faces around a shape", value);
  } else if (faces == Faces::hexagons) {
    require(value >= 4 && value % 2 == 0, name, "even and 4 or more, for hexagons around a shape", value);
  } else {
    require(value >= 3, name, "3 or more, around a shape", value);
  }
}

}  // namespace

void require(bool holds, std::string_view name, std::string_view range, double value) {
  if (!holds) throw Error(ErrorCode::invalid_argument, fmt::format("{} must be {}, not {}", name, range, value));
}

void require_length(std::string_view name, double value) {
  require(value >= least_length && value <= greatest_length, name, "greater than 0, from 1e-100 to 1e100", value);
}

void require_length_or_zero(std::string_view name, double value) {
  require(value == 0 || (value >= least_length && value <= greatest_length), name, "0, or from 1e-100 to 1e100", value);
}

void require_jitter(double value) { require(value >= 0 && value <= 0.5, "jitter", "from 0 to 0.5", value); }

void require_node_count(double value) {
  require(value <= most_nodes, "the number of nodes", "at most 100000000", value);
}

void require_grid(const Grid& grid, Wrapping wrapping) {
  const int faces = static_cast<int>(grid.faces);
  require(faces >= 0 && faces <= static_cast<int>(Faces::hexagons), "faces", "one of the kinds of faces", faces);
  require_cells("columns", grid.columns, grid.faces, wrapping.columns);
  require_cells("rows", grid.rows, grid.faces, wrapping.rows);
  require_jitter(grid.jitter);
  require_node_count((grid.columns + 1.0) * (grid.rows + 1.0));
}

}  // namespace vspring::generate
