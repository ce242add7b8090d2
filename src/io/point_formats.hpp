#pragma once

#include <optional>

#include "io/input_file.hpp"
#include "vspring/point_file.hpp"

namespace vspring {

/// Each reads the points of a file of its format. They throw Error(unusable_file), and Error(invalid_argument) for an
/// invalid choice of columns.
ScatteredPoints read_obj_points(const InputFile& file);
ScatteredPoints read_ply_points(const InputFile& file);
ScatteredPoints read_csv_points(const InputFile& file, const ColumnChoice& choice,
                                const std::optional<LocalPlane>& plane);
ScatteredPoints read_xyz_points(const InputFile& file, const ColumnChoice& choice,
                                const std::optional<LocalPlane>& plane);

/// Whether it is a valid weight of a point.
bool is_point_weight(double weight);

/// Whether it is a valid normal of a point: of length 1, to 1 %, or zero.
bool is_point_normal(const Vector3& normal);

}  // namespace vspring
