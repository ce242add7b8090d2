#pragma once

#include <string>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Points that a shape is to come near to, in no order and without connectivity.
struct ScatteredPoints {
  std::vector<Vector3> positions;
  /// What each counts: its k_j is this times FitOptions::weight. Empty: 1 for all. A point of weight 0 is only
  /// measured.
  std::vector<double> weights = {};
};

/// Reads scattered points: the nodes of a file of a surface or a curve (OBJ, OFF, PLY, STL, CSV, XYZ, DAT),
/// connectivity ignored. path: a file, or "-" for standard input. The format is found from the extension of curves,
/// else from the content.
///
/// Weights: of PLY the vertices' property `weight`, or without one `confidence`; of CSV the column with that name; of
/// XYZ the last column of rows of four or seven numbers (x y z weight, x y z nx ny nz weight). Others have none.
///
/// Throws Error(unusable_file) naming path and line, or point, for what cannot be read, a file without points, and a
/// weight that is not finite or below 0. Cost: linear. Memory: the bytes of the file, and 24 bytes a point, 32 with
/// weights; OFF and STL are read as surfaces are.
[[nodiscard]] ScatteredPoints read_points(const std::string& path);

}  // namespace vspring
