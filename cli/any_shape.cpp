#include "any_shape.hpp"

#include <filesystem>

#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

std::optional<CurveFormat> curve_format_of(const std::optional<AnyFormat>& format) {
  if (format_as<SurfaceFormat>(format) == SurfaceFormat::obj) return CurveFormat::obj;  // OBJ is a format of both kinds
  return format_as<CurveFormat>(format);
}

std::string extension_of(const std::string& path) {
  return path == "-" ? std::string() : std::filesystem::path(path).extension().string();
}

bool is_read_as_curve(const std::string& path, const std::optional<AnyFormat>& format, bool curve) {
  if (curve || format_as<CurveFormat>(format)) return true;
  // Surfaces have OBJ files, too.
  const auto by_extension = curve_format(extension_of(path));
  return !format && by_extension && *by_extension != CurveFormat::obj;
}

/// format: if it is known.
bool may_have_columns(std::optional<CurveFormat> format) {
  return !format || *format == CurveFormat::csv || *format == CurveFormat::xyz || *format == CurveFormat::gpx;
}

}  // namespace

AnyShape read_shape(const std::string& path, std::optional<AnyFormat> format, bool curve, const ColumnChoice& columns,
                    const std::optional<LocalPlane>& plane) {
  if (is_read_as_curve(path, format, curve))
    return read_curve(path, curve_format_of(format), may_be_table(path, format, curve) ? columns : ColumnChoice{},
                      plane);
  SurfaceFile surface = read_surface(path, format_as<SurfaceFormat>(format));
  if (surface.mesh.face_count() > 0 || surface.format != SurfaceFormat::obj) return surface;
  if (path == "-") throw Error(ErrorCode::unusable_file, "standard input: no face in it; for a curve say --curve");
  return read_curve(path, CurveFormat::obj);
}

bool may_be_table(const std::string& path, std::optional<AnyFormat> format, bool curve) {
  if (!is_read_as_curve(path, format, curve)) return false;
  const std::optional<CurveFormat> named = curve_format_of(format);
  return may_have_columns(named ? named : curve_format(extension_of(path)));
}

bool may_be_point_table(const std::string& path) {
  return !surface_format(extension_of(path)) && may_have_columns(curve_format(extension_of(path)));
}

}  // namespace vspring::cli
