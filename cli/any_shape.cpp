#include "any_shape.hpp"

#include <filesystem>

#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

template <typename Format>
std::optional<Format> as(const std::optional<AnyFormat>& format) {
  if (!format || !std::holds_alternative<Format>(*format)) return std::nullopt;
  return std::get<Format>(*format);
}

std::optional<CurveFormat> curve_format_of(const std::optional<AnyFormat>& format) {
  if (as<SurfaceFormat>(format) == SurfaceFormat::obj) return CurveFormat::obj;  // of both kinds
  return as<CurveFormat>(format);
}

}  // namespace

AnyShape read_shape(const std::string& path, std::optional<AnyFormat> format, bool curve) {
  const std::string extension = path == "-" ? std::string() : std::filesystem::path(path).extension().string();
  const auto by_extension = curve_format(extension);
  const bool curves_only = by_extension && *by_extension != CurveFormat::obj;
  if (curve || as<CurveFormat>(format) || (!format && curves_only)) return read_curve(path, curve_format_of(format));
  SurfaceFile surface = read_surface(path, as<SurfaceFormat>(format));
  if (surface.mesh.face_count() > 0 || surface.format != SurfaceFormat::obj) return surface;
  if (path == "-") throw Error(ErrorCode::unusable_file, "standard input: no face in it; for a curve say --curve");
  return read_curve(path, CurveFormat::obj);
}

}  // namespace vspring::cli
