#pragma once

#include <string_view>

#include "vspring/generate.hpp"

namespace vspring::generate {

/// Throws Error(invalid_argument) "`name` must be `range`, not `value`" unless it holds.
void require(bool holds, std::string_view name, std::string_view range, double value);

/// A length greater than 0. Its range keeps squares and sums of coordinates from overflowing and vanishing.
void require_length(std::string_view name, double value);

/// A length that is 0 or passes require_length().
void require_length_or_zero(std::string_view name, double value);

/// Share of a cell within which nodes are shifted.
void require_jitter(double value);

/// A number of nodes that fits the numbering of nodes and of corners.
void require_node_count(double value);

/// Whether a grid closes around.
struct Wrapping {
  bool columns = false;
  bool rows = false;
};

/// Columns, rows, faces and jitter of a grid; see Grid.
void require_grid(const Grid& grid, Wrapping wrapping);

}  // namespace vspring::generate
