#include "vspring/point_file.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "io/column_names.hpp"
#include "io/curve_formats.hpp"
#include "io/formats.hpp"
#include "io/input_file.hpp"
#include "io/point_formats.hpp"
#include "io/surface_formats.hpp"

namespace vspring {
namespace {

ScatteredPoints read_surface_points(InputFile file, SurfaceFormat format) {
  switch (format) {
    case SurfaceFormat::obj:
      return read_obj_points(file);
    case SurfaceFormat::off:
      return {read_off(std::move(file)).mesh.positions()};
    case SurfaceFormat::ply:
      return read_ply_points(file);
    case SurfaceFormat::stl:
      break;
  }
  return {read_stl(std::move(file)).mesh.positions()};
}

ScatteredPoints read_gpx_points(InputFile file, const ColumnChoice& columns, const std::optional<LocalPlane>& plane) {
  const CurveFile curve = read_gpx_curve(std::move(file), columns, plane);
  return {.positions = curve.curve.positions(), .plane = curve.plane, .warnings = curve.warnings};
}

ScatteredPoints points_of(InputFile file, const ColumnChoice& columns, const std::optional<LocalPlane>& plane) {
  const std::string extension = extension_of(file.name);
  std::optional<CurveFormat> curve = curve_format(extension);
  if (!curve || *curve == CurveFormat::obj) {
    std::optional<SurfaceFormat> surface = detect_format(file.bytes);
    if (!surface) surface = surface_format(extension);
    if (surface) {
      refuse_choice(file, columns);
      return read_surface_points(std::move(file), *surface);
    }
  }
  require_utf8(file);
  if (!curve) curve = detect_curve_format(file);
  if (*curve == CurveFormat::dat || *curve == CurveFormat::svg) refuse_choice(file, columns);
  switch (*curve) {
    case CurveFormat::csv:
      return read_csv_points(file, columns, plane);
    case CurveFormat::dat:
      return {read_dat_curve(std::move(file)).curve.positions()};
    case CurveFormat::xyz:
      return read_xyz_points(file, columns, plane);
    case CurveFormat::gpx:
      return read_gpx_points(std::move(file), columns, plane);
    default:
      break;
  }
  file.refuse("SVG is a picture; choose a file of points");
}

}  // namespace

bool is_point_normal(const Vector3& normal) {
  constexpr double tolerance = 0.01;
  return normal.isZero(0) || std::abs(normal.norm() - 1) <= tolerance;
}

bool is_point_weight(double weight) { return std::isfinite(weight) && weight >= 0; }

ScatteredPoints read_points(const std::string& path, const ColumnChoice& columns,
                            const std::optional<LocalPlane>& plane) {
  return points_of(read_input(path), columns, plane);
}

ScatteredPoints read_points_bytes(std::string bytes, const std::string& name, const ColumnChoice& columns,
                                  const std::optional<LocalPlane>& plane) {
  return points_of(input_of(std::move(bytes), name), columns, plane);
}

}  // namespace vspring
