#include "any_shape.hpp"

#include <filesystem>

#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

std::optional<CurveFormat> curve_format_of(const std::optional<AnyFormat>& format) {
  if (format_as<SurfaceFormat>(format) == SurfaceFormat::obj) return CurveFormat::obj;  // of both kinds
  return format_as<CurveFormat>(format);
}

/// Whether a file's extension is one that surfaces do not have.
bool only_for_curves(const std::string& path) {
  const std::string extension = path == "-" ? std::string() : std::filesystem::path(path).extension().string();
  const auto by_extension = curve_format(extension);
  return by_extension && *by_extension != CurveFormat::obj;
}

}  // namespace

AnyShape read_shape(const std::string& path, std::optional<AnyFormat> format, bool curve) {
  const bool curves_only = only_for_curves(path);
  if (curve || format_as<CurveFormat>(format) || (!format && curves_only))
    return read_curve(path, curve_format_of(format));
  SurfaceFile surface = read_surface(path, format_as<SurfaceFormat>(format));
  if (surface.mesh.face_count() > 0 || surface.format != SurfaceFormat::obj) return surface;
  if (path == "-") throw Error(ErrorCode::unusable_file, "standard input: no face in it; for a curve say --curve");
  return read_curve(path, CurveFormat::obj);
}

}  // namespace vspring::cli
