#pragma once

#include <string>
#include <vector>

#include "vspring/column_choice.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Points that a shape is to come near to, in no order and without connectivity.
struct ScatteredPoints {
  std::vector<Vector3> positions;
  /// What each counts: its k_j is this times FitOptions::weight. Empty: 1 for all. A point of weight 0 is only
  /// measured.
  std::vector<double> weights = {};
  /// Which way a surface faces there: unit vectors, to 1 %; zero where that is not known. Empty: nowhere. A point pulls
  /// only at nodes whose normal is within 90° of its own, see fit(). Curves do not look at them.
  std::vector<Vector3> normals = {};
  /// What a person should know of the file: which columns were guessed.
  std::vector<std::string> warnings = {};
};

/// Reads scattered points: the nodes of a file of a surface or a curve (OBJ, OFF, PLY, STL, CSV, XYZ, DAT),
/// connectivity ignored. path: a file, or "-" for standard input. The format is found from the extension of curves,
/// else from the content. columns: of the coordinates, in CSV and XYZ; else found as by read_curve().
///
/// Weights: of PLY the vertices' property `weight`, or without one `confidence`; of CSV the column with that name; of
/// XYZ the last column of rows of four or seven numbers (x y z weight, x y z nx ny nz weight). Others have none.
///
/// Normals: of PLY the properties nx, ny, nz; of CSV the columns with these names; of XYZ numbers four to six of rows
/// of six or seven, where those of the first row are of length 1 or zero (else they are colours); of OBJ the vn
/// statements, where there is one for every v and faces do not use them in another order. Others have none.
///
/// Throws Error(unusable_file) naming path and line, or point, for what cannot be read, a file without points, and a
/// weight that is not finite or below 0, and Error(invalid_argument) for a choice of columns that is none; lengths of
/// normals are looked at by fit(). Cost: linear. Memory: the bytes of the file, and 24 bytes a point, 8 more with
/// weights, 24 more with normals; OFF and STL are read as surfaces are.
[[nodiscard]] ScatteredPoints read_points(const std::string& path, const ColumnChoice& columns = {});

}  // namespace vspring
