#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vspring/column_choice.hpp"
#include "vspring/export.hpp"
#include "vspring/local_plane.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// Points that a shape is drawn to, in no order and without connectivity.
struct ScatteredPoints {
  std::vector<Vector3> positions;  ///< from a flat array by positions_of()
  /// Each point's weight, 0 to 1e50; its k_j is this times Weight::k. Empty: 1 for all. A point of weight 0 is
  /// only measured.
  std::vector<double> weights = {};
  /// The normal of the surface at each point: of unit length, to 1 %; zero where unknown. Empty: unknown everywhere. A
  /// point pulls only at nodes whose normal is within 90° of its own, see fit(). Ignored for curves.
  std::vector<Vector3> normals = {};
  /// Set where the file gives latitudes and longitudes: the plane in which the points lie, in metres, see CurveFile.
  std::optional<LocalPlane> plane = std::nullopt;
  /// For people: which columns were guessed.
  std::vector<std::string> warnings = {};
};

/// Reads scattered points: the nodes of a file of a surface or a curve (OBJ, OFF, PLY, STL, CSV, XYZ, DAT, GPX),
/// connectivity ignored. path: a file, or "-" for standard input. The extension gives the format of curves; other
/// formats are found from the content. columns, plane: as for read_curve().
///
/// Weights: in PLY the property `weight` of the vertices, or without one `confidence`; in CSV the column with that
/// name; in XYZ the last column of rows of four or seven numbers (x y z weight, x y z nx ny nz weight). Other files
/// have none.
///
/// Normals: in PLY the properties nx, ny, nz; in CSV the columns with these names; in XYZ numbers four to six of rows
/// of six or seven, where those of the first row have length 1 or zero (else they are colours); in OBJ the vn
/// statements, where there is one for every v and faces do not use them in another order. Other files have none. Their
/// lengths are checked by fit().
///
/// Throws Error(unusable_file), naming path and line, or point, for what cannot be read, a file without points, and a
/// weight that is not finite or below 0; Error(invalid_argument) for columns that are no choice of columns. Cost:
/// linear. Memory: the bytes of the file, and 24 bytes a point, 8 more with weights, 24 more with normals; OFF and STL
/// are read as surfaces are.
[[nodiscard]] ScatteredPoints read_points(const std::string& path, const ColumnChoice& columns = {},
                                          const std::optional<LocalPlane>& plane = std::nullopt);

/// Reads scattered points from the bytes of a file in memory. name: what messages call it; its extension counts as a
/// path's does. bytes: move them in to avoid a copy. Throws and costs what read_points() does.
[[nodiscard]] ScatteredPoints read_points_bytes(std::string bytes, const std::string& name,
                                                const ColumnChoice& columns = {},
                                                const std::optional<LocalPlane>& plane = std::nullopt);

}  // namespace vspring
