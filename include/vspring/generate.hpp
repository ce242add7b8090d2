#pragma once

#include <cstdint>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Shapes for examples, tests and benchmarks. All lengths are in the units of their arguments, angles in degrees.
/// Every function throws Error(invalid_argument) naming the argument that is out of its range. Cost: linear.
namespace generate {

/// How a grid of (columns × rows) cells is cut into faces.
enum class Faces {
  triangles,  ///< each cell cut along a diagonal, alternating
  quads,
  mixed,    ///< cells left whole, cut in two, and joined in pairs to hexagons, in a fixed pattern
  hexagons  ///< bricks of two cells, shifted by one cell from row to row: six nodes a face, three edges a node
};

// The concrete list of generators is below; each says which nodes come first.

}  // namespace generate
}  // namespace vspring
